"""What `stability` returns: critical loads, each in its bracket, named, with what proves it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from antinode.methods import StabilityMethods
from antinode.modes.result import null

Kind = Literal["flutter", "divergence"]
Change = Literal["lost", "regained", "merged"]
CertificateKind = Literal["counts", "winding", "none"]


@dataclass(frozen=True)
class Certificate:
    """What proves that a bracket holds its change of stability.

    Attributes
    ----------
    kind : {"counts", "winding", "none"}
        Counts of negative eigenvalues at both ends, or, where end forces follow, all eigenvalues
        left of a line in the plane of omega^2, enclosed at both ends; none where that failed.
    unstable : tuple of int
        Modes that diverge or flutter at both ends of the bracket, of the finest chain.
    modes : tuple of int
        Eigenvalues that were enclosed at both ends, with rigid ones; zero for counts, which need
        none.
    """

    kind: CertificateKind
    unstable: tuple[int, int]
    modes: tuple[int, int] = (0, 0)

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        data: dict[str, Any] = {"kind": self.kind, "unstable": list(self.unstable)}
        return data if self.kind == "counts" else data | {"eigenvalues": list(self.modes)}


@dataclass(frozen=True)
class CriticalLoad:
    """A factor at which the stability of a beam changes.

    Attributes
    ----------
    kind : {"flutter", "divergence"}
    load_factor : float
        On all axial forces.
    bracket : tuple of float
        On its two sides, with different numbers of unstable modes; it reaches over the error.
    error : float
        Bound on the distance to the factor of the beam as given.
    frequency_hz, frequency_error_hz : float
        With which it begins to oscillate [Hz]; 0 where it diverges.
    omega2 : float
        Eigenvalue there [rad^2/s^2]; negative where two modes that diverge begin to flutter.
    modes : tuple of str
        Which: two of flutter.
    change : {"lost", "regained", "merged"}
        Stability is lost or regained by a rising factor; merged where modes that diverge already
        begin to flutter.
    certificate : Certificate
    """

    kind: Kind
    load_factor: float
    bracket: tuple[float, float]
    error: float
    frequency_hz: float
    frequency_error_hz: float
    omega2: float
    modes: tuple[str, ...]
    change: Change
    certificate: Certificate

    @property
    def proven(self) -> bool:
        """Whether the bracket is proven to hold the change."""
        return self.certificate.kind != "none"

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        return {
            "kind": self.kind,
            "load_factor": self.load_factor,
            "bracket": list(self.bracket),
            "error": self.error,
            "frequency_hz": self.frequency_hz,
            "frequency_error_hz": self.frequency_error_hz,
            "modes": list(self.modes),
            "change": self.change,
            "certificate": self.certificate.to_dict(),
        }


@dataclass(frozen=True)
class DampedLoss:
    """Where stability is first lost with dampers.

    Attributes
    ----------
    load_factor : float
    bracket : tuple of float
        On its two sides no mode grows, and one does, by more than the error of its growth.
    frequency_hz : float
        Of the mode there [Hz]; 0 where it does not oscillate.
    mode : str
        As it is named just beyond.
    proven : bool
        Whether the lists of modes at both ends of the bracket are proven complete.
    """

    load_factor: float
    bracket: tuple[float, float]
    frequency_hz: float
    mode: str
    proven: bool

    @property
    def kind(self) -> str:
        """Flutter, or divergence."""
        return "flutter" if self.frequency_hz else "divergence"

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        return {
            "kind": self.kind,
            "load_factor": self.load_factor,
            "bracket": list(self.bracket),
            "frequency_hz": self.frequency_hz,
            "modes": [self.mode],
            "proven": self.proven,
        }


@dataclass(frozen=True)
class Stability(StabilityMethods):
    """Every change of stability up to and including the first flutter, by rising factor.

    Attributes
    ----------
    name : str
        Of the beam.
    critical : tuple of CriticalLoad
    range : tuple of float
        Factors that were looked at, from 0; it ends with the first flutter. Infinite where no
        factor at all makes a mode diverge.
    largest_force : float
        The largest abs(N) of the beam under a factor of 1 [N].
    complete : {"counts", "followed"}
        Why no other change lies between: by counts, which can only rise; or because all
        eigenvalues were followed from factor to factor, in steps that keep to them.
    steps : int
        Factors at which all eigenvalues were enclosed.
    warnings : tuple of str
    damped : DampedLoss or None
        Where stability is first lost with the beam's dashpots and loss factors, which all else
        leaves out; None without any, or where it is not lost.
    not_modelled : tuple of str
        What the model leaves out.
    """

    name: str
    critical: tuple[CriticalLoad, ...]
    range: tuple[float, float]
    largest_force: float
    complete: Literal["counts", "followed"]
    steps: int
    warnings: tuple[str, ...] = ()
    damped: DampedLoss | None = None
    not_modelled: tuple[str, ...] = ()

    @property
    def flutter(self) -> CriticalLoad | None:
        """The first flutter, if the range reaches to one."""
        return next((each for each in self.critical if each.kind == "flutter"), None)

    @property
    def first(self) -> CriticalLoad | None:
        """The first loss of stability, if there is one."""
        return next((each for each in self.critical if each.change == "lost"), None)

    def to_dict(self) -> dict[str, Any]:
        """Return it as plain numbers for JSON."""
        return {
            "schema_version": 1,
            "name": self.name,
            "range": [null(value) for value in self.range],
            "critical": [each.to_dict() for each in self.critical],
            "largest_axial_force_n": self.largest_force,
            "damped": self.damped.to_dict() if self.damped else None,
            "between": {"kind": self.complete, "steps": self.steps},
            "not_modelled": list(self.not_modelled),
            "warnings": list(self.warnings),
        }

    def __repr__(self) -> str:
        rows = [f"Stability of {self.name}: factors {self.range[0]:g} to {self.range[1]:.6g}"]
        for each in self.critical:
            at = f" at {each.frequency_hz:.7g} Hz" if each.kind == "flutter" else ""
            proven = "" if each.proven else " (not proven)"
            names = " with ".join(each.modes)
            rows.append(
                f"  {each.load_factor:<15.10g} {each.kind:<10} {names}{at}, {each.change}{proven}"
            )
        if not self.critical:
            rows.append("  stable")
        if self.damped is not None:
            rows.append(f"  with dampers: {self.damped.load_factor:.10g}, {self.damped.kind}")
        return "\n".join(rows)
