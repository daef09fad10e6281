"""The methods that are compared, each in a process of its own, and what is known of each."""

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Method:
    name: str
    module: str  # compare.MODULE; empty: a C++ program
    function: str = "prepare"
    options: dict = field(default_factory=dict)
    environment: dict = field(default_factory=dict)
    needs: str = ""  # a package that may be missing
    share: float = 1.0  # of the poses: what takes long runs over the first of them only
    loses: int = 1  # rounding weighs kappa to this power
    norm: str = "2"
    cores: int = 1
    program: str = ""
    note: str = ""


def ninedof(level, threads=1):
    name = f"ninedof, {level}" + (f", {threads} threads" if threads > 1 else "")
    simd = {"NINEDOF_SIMD": level}
    return Method(name, "with_ninedof", options={"threads": threads}, environment=simd, cores=threads)


def methods(levels):
    best = levels[-1]
    frobenius = {"threads": 1, "norm": "frobenius"}
    return [
        *(ninedof(level) for level in levels),
        ninedof(best, 2),
        Method(
            f"ninedof, {best}, Frobenius norm",
            "with_ninedof",
            options=frobenius,
            environment={"NINEDOF_SIMD": best},
            norm="frobenius",
        ),
        *(
            Method(f"plain Eigen, {level}", "", share=0.2, program=f"ninedof_plain_eigen_{level}", note="J', JacobiSVD")
            for level in levels
        ),
        Method("numpy", "with_numpy", note="J', linalg.svd"),
        Method(
            "numpy, eigenvalues",
            "with_numpy",
            "prepare_eigenvalues",
            loses=2,
            note="J'J'^T, linalg.eigvalsh: half the digits",
        ),
        Method("SciPy", "with_scipy", share=0.02, note="linalg.svdvals, one by one"),
        Method("JAX", "with_jax", needs="jax", share=0.1, note="jit and vmap, double precision"),
        Method("CasADi and numpy", "with_casadi", needs="casadi", share=0.1, note="J' by CasADi, linalg.svd"),
        Method(
            "CasADi, Frobenius norm",
            "with_casadi",
            "prepare_frobenius",
            needs="casadi",
            share=0.1,
            loses=2,
            norm="frobenius",
            note="closed form, no singular values",
        ),
    ]
