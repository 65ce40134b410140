"""The library of faststrip for Spack, built by CMake from the source distribution, which lies
beside the folder `spack`. `./run package` fills in version and sum."""

import pathlib

from spack.package import depends_on, license, variant, version
from spack_repo.builtin.build_systems.cmake import CMakePackage


class Faststrip(CMakePackage):
    """Wheel/rail contact by the modified strip method: a library for C, Fortran and Fortran 77."""

    url = f"file://{pathlib.Path(__file__).resolve().parents[5]}/faststrip-@VERSION@.tar.gz"

    license("MIT")

    version("@VERSION@", sha256="@SHA256@")

    variant("lapack", default=True, description="Take LAPACK, not routines of its own")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.18:", type="build")
    depends_on("lapack", when="+lapack")

    def cmake_args(self):
        """Options beside those of Spack."""
        return [self.define("FASTSTRIP_OWN_LAPACK", self.spec.satisfies("~lapack"))]
