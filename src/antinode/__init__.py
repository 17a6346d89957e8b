"""antinode: natural vibration of slender vehicles in motion, and of any beam.

    import antinode as an
    result = an.solve_modes(an.load_case("case.toml"))

Names are imported from their modules on first use, so that importing antinode costs nothing.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .app.server import run_app
    from .beam.attachments import Dashpot, Joint, Pedestal, PointFeedback, PointMass, Spring
    from .beam.beam import Beam
    from .beam.ends import Ends
    from .beam.file import BeamFile, load_beam
    from .beam.sections.drawn import drawn_beam
    from .beam.sections.material import Material
    from .beam.sections.section import Section
    from .errors import AntinodeError, ComputationError, InputError
    from .examples import write_example
    from .exchange.convert import convert_file as convert
    from .modes.batch import BatchResult, BeamBatch, solve_many
    from .modes.buckling import Buckling, buckling
    from .modes.frequencies import Frequencies, natural_frequencies
    from .modes.result import ModalResult, Mode
    from .modes.solve import solve_modes
    from .modes.verify import run_checks as verify
    from .paper.comparison import compare as reproduce
    from .proof.prove import Proof, prove
    from .report.command import report_file as write_report
    from .response.damping import Damping
    from .response.file import load_response
    from .response.frequency import frequency_response
    from .response.quantities import Base, Force, Output
    from .response.shock import srs
    from .response.solve import beam_response, solve_response
    from .stability.influence import Influence, critical_influence
    from .stability.loci import Loci, root_loci
    from .stability.result import CriticalLoad, Stability
    from .stability.stability import stability
    from .study.along.along import stability_along, stability_map
    from .study.along.result import Along, StabilityMap
    from .study.answers.answers import Answers, case_table
    from .study.answers.search import search
    from .study.design.file import Study
    from .study.design.loading import load_study
    from .study.identify.file import IdentificationProblem, load_identification
    from .study.identify.identification import identify
    from .study.identify.result import Identification
    from .study.schema import schema
    from .study.sensitivity.sensitivity import sensitivity
    from .study.sweep.folder import open_store
    from .study.sweep.sweep import sweep
    from .vehicle.case import Case, load_case
    from .vehicle.condition import OperatingCondition, Water
    from .vehicle.loads import Loads, compute_loads
    from .vehicle.options import Model
    from .vehicle.statics import static_shape
    from .vehicle.vehicle import Cavitator, FinSet, Stations, Vehicle
    from .version import __version__

_HOME = {
    "beam_response": "response.solve",
    "convert": "exchange.convert:convert_file",
    "reproduce": "paper.comparison:compare",
    "run_app": "app.server",
    "schema": "study.schema",
    "static_shape": "vehicle.statics",
    "verify": "modes.verify:run_checks",
    "write_example": "examples",
    "write_report": "report.command:report_file",
    "BatchResult": "modes.batch",
    "BeamBatch": "modes.batch",
    "Buckling": "modes.buckling",
    "buckling": "modes.buckling",
    "solve_many": "modes.batch",
    "Beam": "beam.beam",
    "Ends": "beam.ends",
    "BeamFile": "beam.file",
    "Dashpot": "beam.attachments",
    "Joint": "beam.attachments",
    "Pedestal": "beam.attachments",
    "Material": "beam.sections.material",
    "Section": "beam.sections.section",
    "drawn_beam": "beam.sections.drawn",
    "PointFeedback": "beam.attachments",
    "PointMass": "beam.attachments",
    "Spring": "beam.attachments",
    "load_beam": "beam.file",
    "Case": "vehicle.case",
    "load_case": "vehicle.case",
    "OperatingCondition": "vehicle.condition",
    "Water": "vehicle.condition",
    "AntinodeError": "errors",
    "ComputationError": "errors",
    "InputError": "errors",
    "Frequencies": "modes.frequencies",
    "natural_frequencies": "modes.frequencies",
    "Loads": "vehicle.loads",
    "compute_loads": "vehicle.loads",
    "Model": "vehicle.options",
    "solve_modes": "modes.solve",
    "prove": "proof.prove",
    "Proof": "proof.prove",
    "ModalResult": "modes.result",
    "Mode": "modes.result",
    "Base": "response.quantities",
    "Damping": "response.damping",
    "Force": "response.quantities",
    "Output": "response.quantities",
    "frequency_response": "response.frequency",
    "load_response": "response.file",
    "solve_response": "response.solve",
    "srs": "response.shock",
    "CriticalLoad": "stability.result",
    "critical_influence": "stability.influence",
    "Influence": "stability.influence",
    "Loci": "stability.loci",
    "root_loci": "stability.loci",
    "Along": "study.along.result",
    "Stability": "stability.result",
    "StabilityMap": "study.along.result",
    "stability_along": "study.along.along",
    "stability_map": "study.along.along",
    "stability": "stability.stability",
    "Identification": "study.identify.result",
    "identify": "study.identify.identification",
    "IdentificationProblem": "study.identify.file",
    "load_identification": "study.identify.file",
    "Study": "study.design.file",
    "load_study": "study.design.loading",
    "sweep": "study.sweep.sweep",
    "sensitivity": "study.sensitivity.sensitivity",
    "open_store": "study.sweep.folder",
    "Answers": "study.answers.answers",
    "case_table": "study.answers.answers",
    "search": "study.answers.search",
    "Cavitator": "vehicle.vehicle",
    "FinSet": "vehicle.vehicle",
    "Stations": "vehicle.vehicle",
    "Vehicle": "vehicle.vehicle",
    "__version__": "version",
}

__all__ = [
    "Along",
    "Answers",
    "AntinodeError",
    "Base",
    "BatchResult",
    "Beam",
    "BeamBatch",
    "BeamFile",
    "Buckling",
    "Case",
    "Cavitator",
    "ComputationError",
    "CriticalLoad",
    "Damping",
    "Dashpot",
    "Ends",
    "FinSet",
    "Force",
    "Frequencies",
    "Identification",
    "IdentificationProblem",
    "Influence",
    "InputError",
    "Joint",
    "Loads",
    "Loci",
    "Material",
    "ModalResult",
    "Mode",
    "Model",
    "OperatingCondition",
    "Output",
    "Pedestal",
    "PointFeedback",
    "PointMass",
    "Proof",
    "Section",
    "Spring",
    "Stability",
    "StabilityMap",
    "Stations",
    "Study",
    "Vehicle",
    "Water",
    "__version__",
    "beam_response",
    "buckling",
    "case_table",
    "compute_loads",
    "convert",
    "critical_influence",
    "drawn_beam",
    "frequency_response",
    "identify",
    "load_beam",
    "load_case",
    "load_identification",
    "load_response",
    "load_study",
    "natural_frequencies",
    "open_store",
    "prove",
    "reproduce",
    "root_loci",
    "run_app",
    "schema",
    "search",
    "sensitivity",
    "solve_many",
    "solve_modes",
    "solve_response",
    "srs",
    "stability",
    "stability_along",
    "stability_map",
    "static_shape",
    "sweep",
    "verify",
    "write_example",
    "write_report",
]


def __getattr__(name: str) -> Any:
    if name not in _HOME:
        raise AttributeError(f"module 'antinode' has no attribute '{name}'")
    home, _, own = _HOME[name].partition(":")
    found = getattr(importlib.import_module(f".{home}", __name__), own or name)
    globals()[name] = found
    return found


def __dir__() -> list[str]:
    return __all__
