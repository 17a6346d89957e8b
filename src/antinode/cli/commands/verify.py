"""`antinode verify`: this installation against closed forms."""

from __future__ import annotations

from antinode.cli.options import Json
from antinode.errors import ComputationError
from antinode.show.outcome import print_json


def verify(*, json: Json = False) -> None:
    """Check this installation against closed forms, in seconds.

    - Example: **antinode verify**
    """
    from antinode.modes.verify import ALLOWED, run_checks

    checks = run_checks()
    failed = sum(not check.passed for check in checks)
    if json:
        rows = [check.to_dict() for check in checks]
        print_json({"schema_version": 1, "allowed": ALLOWED, "checks": rows})
    else:
        from antinode.show.printing import show_checks

        show_checks(checks)
    if failed:
        raise ComputationError(f"{failed} of {len(checks)} checks failed; reinstall antinode")
