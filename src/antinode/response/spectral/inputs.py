"""The spectra of all drives, and how they go together."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from antinode.arrays import Array, Numbers
from antinode.errors import InputError
from antinode.response.file import Problem
from antinode.response.spectra import Spectrum, spectrum_from
from antinode.response.units import spectral


class Inputs:
    """The spectra of all drives, and how they go together.

    Parameters
    ----------
    spectra : sequence of Spectrum
        One for each drive.
    coherence : array, shape (drives, drives), complex, optional
        ``S_jk/sqrt(S_jj S_kk)``; independent by default.

    Raises
    ------
    InputError
        If no random forces can go together so.
    """

    def __init__(self, spectra: Sequence[Spectrum], coherence: Numbers | None = None) -> None:
        self.spectra = tuple(spectra)
        n = len(self.spectra)
        self.coherence = np.eye(n, dtype=complex) if coherence is None else coherence
        if np.min(np.linalg.eigvalsh(self.coherence)) < -1e-9:
            raise InputError(
                "coherence: no random forces can be coherent so; if 1 goes with 2 and 2 with 3, "
                "then 1 must go with 3: give that coherence too"
            )

    @property
    def kinks(self) -> Array:
        """Where any of the spectra bends [Hz]."""
        return np.unique(np.concatenate([s.frequency_hz for s in self.spectra]))

    def amplitudes(self, frequency_hz: Array) -> Array:
        """Return the roots of the spectra, shape (drives, k)."""
        return np.asarray(np.sqrt(np.array([s.at(frequency_hz) for s in self.spectra])))

    def shares(self, H: Numbers, frequency_hz: Array) -> Array:
        """Return what each drive makes of the outputs' spectra, (outputs, drives, k)."""
        X = H * self.amplitudes(frequency_hz)
        together = np.einsum("jl,olk->ojk", self.coherence, X)
        return np.asarray(np.real(np.conj(X) * together))

    def spectra_of(self, H: Numbers, frequency_hz: Array) -> Array:
        """Return the outputs' spectra, (outputs, k)."""
        return np.asarray(np.maximum(np.sum(self.shares(H, frequency_hz), axis=1), 0.0))


def inputs_of(problem: Problem) -> Inputs:
    """Return the spectra of a file's drives.

    Raises
    ------
    InputError
        If a spectrum does not cover the band, or forces that go together are not there.
    """
    file = problem.file
    assert file.frequency is not None
    f = file.frequency.hertz()
    spectra = []
    for (name, table), drive in zip(file.drive_tables(), file.drives, strict=True):
        where = f"{problem.where}: {name}.psd"
        spectrum = spectrum_from(table.psd, spectral(drive.unit), problem.folder, where)
        spectrum.check_covers(float(f[0]), float(f[-1]))
        spectra.append(spectrum)
    names = list(file.drive_names)
    coherence = np.eye(len(names), dtype=complex)
    for k, entry in enumerate(file.coherence):
        for name in entry.forces:
            if names.count(name) != 1:
                raise InputError(
                    f"{problem.where}: coherence.{k}: there is no one force named '{name}'; forces "
                    f"are {', '.join(names)}"
                )
        i, j = (names.index(name) for name in entry.forces)
        coherence[i, j] = np.sqrt(entry.value) * np.exp(1j * entry.phase)
        coherence[j, i] = np.conj(coherence[i, j])
    return Inputs(spectra, coherence)
