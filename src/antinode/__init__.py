"""antinode: natural vibration of slender vehicles in motion, and of any beam.

    import antinode as an
    result = an.solve_modes(an.load_case("case.toml"))

Names are imported from their modules on first use, so that importing antinode costs nothing.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from .batch import BatchResult, BeamBatch, solve_many
    from .beam import Beam, Ends
    from .beam_file import BeamFile, load_beam
    from .case import Case, load_case
    from .condition import OperatingCondition, Water
    from .errors import AntinodeError, ComputationError, InputError
    from .frequencies import Frequencies, natural_frequencies
    from .loads import Loads, compute_loads
    from .model import Model
    from .modes import solve_modes
    from .result import ModalResult, Mode
    from .study.identification import Identification, identify
    from .study.identification_file import IdentificationProblem, load_identification
    from .study.sensitivity import sensitivity
    from .study.store import open_store
    from .study.study_file import Study, load_study
    from .study.sweep import sweep
    from .vehicle import Cavitator, FinSet, Stations, Vehicle

_HOME = {
    "BatchResult": "batch",
    "BeamBatch": "batch",
    "solve_many": "batch",
    "Beam": "beam",
    "Ends": "beam",
    "BeamFile": "beam_file",
    "load_beam": "beam_file",
    "Case": "case",
    "load_case": "case",
    "OperatingCondition": "condition",
    "Water": "condition",
    "AntinodeError": "errors",
    "ComputationError": "errors",
    "InputError": "errors",
    "Frequencies": "frequencies",
    "natural_frequencies": "frequencies",
    "Loads": "loads",
    "compute_loads": "loads",
    "Model": "model",
    "solve_modes": "modes",
    "ModalResult": "result",
    "Mode": "result",
    "Identification": "study.identification",
    "identify": "study.identification",
    "IdentificationProblem": "study.identification_file",
    "load_identification": "study.identification_file",
    "Study": "study.study_file",
    "load_study": "study.study_file",
    "sweep": "study.sweep",
    "sensitivity": "study.sensitivity",
    "open_store": "study.store",
    "Cavitator": "vehicle",
    "FinSet": "vehicle",
    "Stations": "vehicle",
    "Vehicle": "vehicle",
}

__all__ = [
    "AntinodeError",
    "BatchResult",
    "Beam",
    "BeamBatch",
    "BeamFile",
    "Case",
    "Cavitator",
    "ComputationError",
    "Ends",
    "FinSet",
    "Frequencies",
    "Identification",
    "IdentificationProblem",
    "InputError",
    "Loads",
    "ModalResult",
    "Mode",
    "Model",
    "OperatingCondition",
    "Stations",
    "Study",
    "Vehicle",
    "Water",
    "__version__",
    "compute_loads",
    "identify",
    "load_beam",
    "load_case",
    "load_identification",
    "load_study",
    "natural_frequencies",
    "open_store",
    "sensitivity",
    "solve_many",
    "solve_modes",
    "sweep",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'antinode' has no attribute '{name}'")
    found = getattr(importlib.import_module(f".{_HOME[name]}", __name__), name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return __all__
