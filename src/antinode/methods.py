"""What objects can do, as methods: functions that stand far above them, named in this table.

A beam knows no modes, a modal result no figures: nothing below imports what is above it. Here each
class gets the functions that take it as their first argument, by name; one is imported when it is
first called. `beam.modes(6)` is `solve_modes(beam, 6)`: one function, with one docstring.
"""

from __future__ import annotations

import importlib
from types import MethodType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from .beam.families import FamilyName
    from .exchange import saving
    from .modes import buckling as _buckling
    from .modes import frequencies
    from .modes.backends import BackendName
    from .modes.buckling import Buckling
    from .modes.result import Damping as Whether
    from .modes.result import Method as Kinds
    from .modes.result import ModalResult, Normalisation
    from .proof.prove import Proof
    from .response import solve as responses
    from .response.damping import Damping
    from .response.frequency import FrequencyResponse
    from .response.quantities import Drive, Output
    from .show.objects import cards, frames, plots
    from .stability.result import Stability
    from .study import cards as study_cards
    from .study import frames as study_frames
    from .study import plots as study_plots
    from .study.identify import identification
    from .study.sensitivity import sensitivity as sensitivities
    from .study.sweep import sweep as sweeps
    from .vehicle import statics


class Method:
    """A function of a module of antinode as a method: imported when it is first asked for."""

    def __init__(self, module: str, function: str) -> None:
        self.module, self.function = module, function

    def __get__(self, instance: object, owner: type | None = None) -> Any:
        function = getattr(importlib.import_module(f"antinode.{self.module}"), self.function)
        return function if instance is None else MethodType(function, instance)


class SolvedMethods:
    """Of whatever is solved as a beam: what the commands compute."""

    if TYPE_CHECKING:  # decorated functions stand here with their signatures

        def modes(  # noqa: D102
            self,
            modes: int = 6,
            *,
            tolerance: float = 1e-6,
            families: Sequence[FamilyName] | None = None,
            method: Kinds = "riccati",
            normalisation: Normalisation = "amplitude",
            unloaded: bool = False,
            backend: BackendName = "auto",
            damping: Whether = "auto",
        ) -> ModalResult: ...

        def buckling(  # noqa: D102
            self, tolerance: float = 1e-6, *, backend: BackendName = "auto"
        ) -> Buckling | None: ...

        def stability(  # noqa: D102
            self,
            largest: float | None = None,
            *,
            tolerance: float = 1e-9,
            dampers: bool = True,
            backend: BackendName | None = None,
        ) -> Stability: ...

        def frequency_response(  # noqa: D102
            self,
            frequency_hz: npt.ArrayLike,
            drives: Sequence[Drive],
            outputs: Sequence[Output],
            *,
            damping: Damping = ...,
            tolerance: float = 1e-6,
            backend: BackendName = "auto",
        ) -> FrequencyResponse: ...

        frequencies = frequencies.natural_frequencies
        response = responses.beam_response
    else:
        modes = Method("modes.solve", "solve_modes")
        frequencies = Method("modes.frequencies", "natural_frequencies")
        buckling = Method("modes.buckling", "buckling")
        stability = Method("stability.stability", "stability")
        response = Method("response.solve", "beam_response")
        frequency_response = Method("response.frequency", "frequency_response")


class BeamMethods(SolvedMethods):
    """Of `Beam`, and of `BeamFile`, which has one."""

    if TYPE_CHECKING:
        plot = plots.beam_axes
        to_dataframe = frames.beam_frame
        save = saving.save_beam
        _repr_html_ = cards.beam_card
    else:
        plot = Method("show.objects.plots", "beam_axes")
        to_dataframe = Method("show.objects.frames", "beam_frame")
        save = Method("exchange.saving", "save_beam")
        _repr_html_ = Method("show.objects.cards", "beam_card")
        __repr__ = Method("show.objects.lines", "beam_line")


class CaseMethods(SolvedMethods):
    """Of `Case`, a vehicle in a condition; `case.loads` are its loads, called or not."""

    if TYPE_CHECKING:
        statics = statics.static_shape
        plot = plots.case_axes
        to_dataframe = frames.case_frame
        save = frames.save_loads
        _repr_html_ = cards.case_card
    else:
        statics = Method("vehicle.statics", "static_shape")
        plot = Method("show.objects.plots", "case_axes")
        to_dataframe = Method("show.objects.frames", "case_frame")
        save = Method("show.objects.frames", "save_loads")
        _repr_html_ = Method("show.objects.cards", "case_card")
        __repr__ = __str__ = Method("show.objects.lines", "case_line")


class LoadsMethods:
    """Of `Loads`."""

    if TYPE_CHECKING:
        plot = plots.loads_axes
        to_dataframe = frames.loads_frame
        _repr_html_ = cards.loads_card
    else:
        plot = Method("show.objects.plots", "loads_axes")
        to_dataframe = Method("show.objects.frames", "loads_frame")
        _repr_html_ = Method("show.objects.cards", "loads_card")
        __repr__ = Method("show.objects.lines", "loads_line")


class ModesMethods:
    """Of `ModalResult`."""

    if TYPE_CHECKING:
        plot = plots.modes_axes
        to_dataframe = frames.modes_frame
        save = saving.save_modes
        buckling = _buckling.buckling_of

        def prove(self) -> Proof: ...  # noqa: D102

        def _own_warnings(self) -> list[str]: ...

        _repr_html_ = cards.modes_card
    else:
        plot = Method("show.objects.plots", "modes_axes")
        to_dataframe = Method("show.objects.frames", "modes_frame")
        save = Method("exchange.saving", "save_modes")
        buckling = Method("modes.buckling", "buckling_of")
        prove = Method("proof.prove", "prove")
        _own_warnings = Method("modes.warnings", "warnings_of")
        _repr_html_ = Method("show.objects.cards", "modes_card")
        __repr__ = Method("show.objects.lines", "modes_line")


class ModeMethods:
    """Of `Mode`."""

    if not TYPE_CHECKING:
        __repr__ = Method("show.objects.lines", "mode_line")


class StabilityMethods:
    """Of `Stability`."""

    if TYPE_CHECKING:
        to_dataframe = frames.stability_frame
        _repr_html_ = cards.stability_card
    else:
        to_dataframe = Method("show.objects.frames", "stability_frame")
        _repr_html_ = Method("show.objects.cards", "stability_card")


class AlongMethods:
    """Of `Along`."""

    if TYPE_CHECKING:
        to_dataframe = frames.along_frame
    else:
        to_dataframe = Method("show.objects.frames", "along_frame")


class ResponseMethods:
    """Of the four kinds of response."""

    if TYPE_CHECKING:
        plot = plots.response_axes
        to_dataframe = frames.response_frame
        save = saving.save_response
        _repr_html_ = cards.response_card
    else:
        plot = Method("show.objects.plots", "response_axes")
        to_dataframe = Method("show.objects.frames", "response_frame")
        save = Method("exchange.saving", "save_response")
        _repr_html_ = Method("show.objects.cards", "response_card")
        __repr__ = __str__ = Method("show.objects.lines", "response_line")


class StudyMethods:
    """Of `Study`."""

    if TYPE_CHECKING:
        run = sweeps.sweep
        sensitivity = sensitivities.sensitivity
        plot = study_plots.sweep_axes
        _repr_html_ = study_cards.study_card
    else:
        run = Method("study.sweep.sweep", "sweep")
        sensitivity = Method("study.sensitivity.sensitivity", "sensitivity")
        plot = Method("study.plots", "sweep_axes")
        _repr_html_ = Method("study.cards", "study_card")
        __repr__ = __str__ = Method("study.cards", "study_line")


class SensitivityMethods:
    """Of `SensitivityResult`."""

    if TYPE_CHECKING:
        plot = study_plots.sensitivity_axes
        to_dataframe = study_frames.sensitivity_frame
        _repr_html_ = study_cards.sensitivity_card
    else:
        plot = Method("study.plots", "sensitivity_axes")
        to_dataframe = Method("study.frames", "sensitivity_frame")
        _repr_html_ = Method("study.cards", "sensitivity_card")
        __repr__ = Method("study.cards", "sensitivity_line")


class ProblemMethods:
    """Of `IdentificationProblem`."""

    if TYPE_CHECKING:
        run = identification.identify
        _repr_html_ = study_cards.problem_card
    else:
        run = Method("study.identify.identification", "identify")
        _repr_html_ = Method("study.cards", "problem_card")
        __repr__ = __str__ = Method("study.cards", "problem_line")


class IdentificationMethods:
    """Of `Identification`."""

    if TYPE_CHECKING:
        plot = study_plots.identification_axes
        to_dataframe = study_frames.identification_frame
        save = study_frames.save_identification
        _repr_html_ = study_cards.identification_card
    else:
        plot = Method("study.plots", "identification_axes")
        to_dataframe = Method("study.frames", "identification_frame")
        save = Method("study.frames", "save_identification")
        _repr_html_ = Method("study.cards", "identification_card")
        __repr__ = Method("study.cards", "identification_line")
