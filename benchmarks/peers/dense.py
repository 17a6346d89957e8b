"""Hermite elements and LAPACK's dense generalised eigensolver, lowest eigenvalues only."""

from scipy.linalg import lapack

from .hermite import bands, full


def omega2(h, m, EI, N, modes):
    K, M = bands(h, m, EI, N)
    values, _, found, _, failed = lapack.dsygvx(
        full(K), full(M), jobz="N", uplo="U", range="I", il=1, iu=modes + 2,
        overwrite_a=1, overwrite_b=1,
    )  # fmt: skip
    assert not failed
    assert found == modes + 2
    return values[2 : modes + 2]
