"""`antinode beam`: frequencies and modes of any beam."""

from __future__ import annotations

import sys
from pathlib import Path

from antinode.cli.modal import check_modal_output, draw_effects, solve, write_modes
from antinode.cli.options import BeamSet, BucklingFactor, Effects, Output, Prove, Solver
from antinode.extras import import_extra
from antinode.show.outcome import draw

_SOLVER, _OUTPUT = Solver(), Output()


def beam(
    file: Path,
    /,
    *,
    set_: BeamSet = (),
    solver: Solver = _SOLVER,
    buckling: BucklingFactor = False,
    prove: Prove = False,
    effects: Effects = None,
    output: Output = _OUTPUT,
) -> None:
    """Compute frequencies and modes of any beam, with no vehicle at all.

    The file gives mass, stiffness and axial force N (positive in compression) at stations, how the
    ends are held, and what is attached.

    - Example: **antinode beam beam.toml**
    - Example: **antinode beam beam.toml --set beam.ends.left=pinned --plot beam.svg**
    - Example: **antinode beam beam.toml --buckling -o beam.csv**
    - Example: **antinode beam beam.toml --effects effects.png**
    - Example: **antinode beam beam.toml --prove --json**

    Parameters
    ----------
    file
        A beam file in TOML. 'antinode init --beam' writes one.
    """
    check_modal_output(output, effects)
    if prove:
        import_extra("flint", "prove")
    from antinode.beam.file import load_beam

    result = solve(load_beam(file, set_), solver)
    critical = None
    if buckling:
        from antinode.modes.buckling import buckling_of

        critical = buckling_of(result)
    proof = result.prove() if prove else None
    if proof:
        result = proof.applied(result)
    found = {"buckling": critical.to_dict() if critical else None} if buckling else {}
    if output.plot:
        from antinode.show.figures import plot_modes

        draw(plot_modes(result), output.plot)
    draw_effects(result, effects)
    write_modes(output, result, lambda: result.to_dict() | found)
    if not output.json:
        from antinode.show.printing import console, show_beam, show_buckling, show_modes

        out = console()
        show_beam(out, result.beam)
        if buckling:
            show_buckling(out, critical)
        show_modes(out, result)
        if proof:
            out.print(proof.sentence[0].upper() + proof.sentence[1:] + ".", soft_wrap=True)
    if proof and not proof.proven:
        sys.exit(3)
