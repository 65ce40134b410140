"""The callers of the pages, compiled by their lines against the installation alone, and C++."""

import re

from installed import CALLERS, ROOT, HostTest, callers

FILES = {"fortran": "caller.f90", "f77": "caller.f", "c": "caller.c", "python": "caller.py"}


class Callers(HostTest):
    def results(self, line, **environment):
        """Status, penetration and longitudinal force that a caller printed."""
        status, *numbers = self.shell(line, **environment).split()
        return int(status), *(float(number) for number in numbers)

    def test_the_callers_print_what_pages_show(self):
        """To the character, whatever the language: as many digits as every build reproduces."""
        shown = [line for page, _ in CALLERS
                 for line in re.findall(r"(?m)^0 .*E[+-]\d\d$",
                                        (ROOT / page).read_text(encoding="utf-8"))]
        self.assertEqual((len(shown), len(set(shown))), (4, 1))
        found = {}
        (self.folder / ".venv").symlink_to(ROOT / ".venv")
        for language, text in callers():
            if language in FILES:
                self.write(FILES[language], text)
            else:
                self.shell(text, PYTHONPATH=str(ROOT / "python"))
                for program in re.findall(r"-o (\w+)", text):
                    found[program] = self.shell(f"./{program}")
        found["python"] = self.shell(f"'{ROOT}/.venv/bin/python' caller.py",
                                     PYTHONPATH=str(ROOT / "python"))
        self.assertEqual(found, dict.fromkeys(("caller_fortran", "caller_f77", "caller_c",
                                               "python"), f"{shown[0]}\n"))
        status, penetration, force = self.results("./caller_c")
        self.assertEqual(status, 0)
        # Hertz: 0.10799 mm; a little less than half of what friction can carry.
        self.assertAlmostEqual(penetration, 0.10799, delta=1e-4)
        self.assertAlmostEqual(force, -12.23e3, delta=200.0)

    def test_cplusplus_static_and_without_underscores(self):
        sources = dict(callers())
        self.write("caller.cpp", sources["c"])
        self.shell("g++ -std=c++11 -Wall -Wextra -pedantic -Werror caller.cpp"
                   " $(pkg-config --cflags --libs faststrip) -o caller_cpp")
        self.write("caller.f", sources["f77"])
        self.shell("gfortran -std=legacy -fno-underscoring caller.f"
                   f" '{self.installed.archive}' -lopenblas -o caller_static")
        self.assertEqual(self.results("./caller_cpp"), self.results("./caller_static"))
        self.assertNotIn("libfaststrip", self.shell("ldd caller_static"))

    def test_static_linking_by_pkg_config(self):
        """Against the archive alone: static altogether, or but for the system's libraries."""
        sources = dict(callers())
        self.write("caller.c", sources["c"])
        self.write("caller.cpp", sources["c"])
        self.write("caller.f", sources["f77"])
        self.write("caller.f90", sources["fortran"])
        self.shell(f"cp -r '{self.installed.prefix}' archive; rm archive/lib/*.so*;"
                   " sed -i \"s|^prefix=.*|prefix=$PWD/archive|\""
                   " archive/lib/pkgconfig/faststrip.pc")
        found = set()
        for compiler, source in (
            ("gcc", "caller.c"), ("gcc -static-libgcc", "caller.c"), ("gcc -static", "caller.c"),
            ("g++ -static", "caller.cpp"), ("gfortran -static-libgfortran", "caller.f90"),
            ("gfortran -static-libgfortran", "caller.c"),
            ("gfortran -static", "caller.f90"), ("gfortran -std=legacy -static", "caller.f"),
        ):
            with self.subTest(compiler=compiler, source=source):
                self.shell(f"{compiler} {source} $(pkg-config --static --cflags --libs faststrip)"
                           " -o static_caller",
                           PKG_CONFIG_PATH=str(self.folder / "archive" / "lib" / "pkgconfig"))
                needed = self.shell("ldd ./static_caller || true")
                self.assertNotIn("libfaststrip", needed)
                if compiler.endswith("-static"):
                    self.assertIn("not a dynamic executable", needed)
                found.add(self.results("./static_caller", LD_LIBRARY_PATH=""))
        self.assertEqual(len(found), 1, found)

    def test_hosts_that_trap(self):
        sources = dict(callers())
        traps = "-g -ffpe-trap=invalid,zero,overflow,underflow"
        for language, name, flags in (("fortran", "caller.f90", "--cflags --libs"),
                                      ("f77", "caller.f", "--libs")):
            self.write(name, sources[language])
            self.shell(f"gfortran -std=legacy {traps} {name}"
                       f" $(pkg-config {flags} faststrip) -o trapping")
            self.assertEqual(self.results("./trapping")[0], 0)

    def test_the_header_compiles_alone_in_old_dialects(self):
        self.write("header.c", "#include <faststrip.h>\n#include <faststrip.h>\nint x;\n")
        for compiler in ("gcc -std=c90", "gcc -std=c11", "g++ -x c++ -std=c++98"):
            self.shell(f"{compiler} -Wall -Wextra -pedantic -Werror -c header.c -o header.o"
                       " $(pkg-config --cflags faststrip)")
