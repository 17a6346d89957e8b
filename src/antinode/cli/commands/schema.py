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
    from antinode.show.schema import input_schema

    if of == "study":
        from antinode.study.design.schema import study_schema

        print_json(study_schema())
    elif of == "identify":
        from antinode.study.identify.schema import identification_schema

        print_json(identification_schema())
    else:
        print_json(input_schema(of))
