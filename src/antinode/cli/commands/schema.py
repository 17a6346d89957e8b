"""`antinode schema`: every key of an input file."""

from __future__ import annotations

from antinode.show.outcome import print_json


def schema(of: str = "case", /) -> None:
    """Print the JSON schema of an input file, every key with its unit and range.

    - Example: **antinode schema case**
    - Example: **antinode schema beam > beam.schema.json**

    Parameters
    ----------
    of
        case, beam, response, study or identify.
    """
    from antinode.study.schema import schema as of_file

    print_json(of_file(of))
