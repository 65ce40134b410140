"""What ./run install puts below a prefix: names, versions, what the library needs."""

import ast
import gzip
import re
import shutil
import stat
import subprocess
import tomllib

from installed import ROOT, HostTest

# GPL libraries, of which nothing may get into the installed library.
FORBIDDEN = re.compile(r"gsl|fftw", re.IGNORECASE)
NEEDED = {"libopenblas", "libgfortran", "libm", "libmvec", "libgcc_s", "libquadmath", "libc",
          "ld-linux-x86-64"}
F77_NAMES = set("fstsim fskalk fsherz fsdflt fsinit fsgap fssolv fscont fsstrp fselem fslimt"
                " fscurv fsgapt"
                " fserrs fsferr fslset fswant fstakn fsstep fsprof fscopy fsfree fsmsg fslast"
                " fsints fswdft fswnew fsrail fsptch fsaxle fsprat fsdamp fsspri fswslv fswset"
                " fswstr fswelm fswstw fsroll fsrprf fswcpy fswsav fswrst fswfre fsderv fswdrv"
                " fsfric fsfrtb fswear fsstwr fsheat fsflsh fstemp"
                " fscfun fsconi fslopn fslfre fslinf fslook fslwin fslcon"
                " fslwze fswlkp fslwhl fsrdpr fsdoub fsgivn fscrep fsstrs fspeak".split())

CORE = ROOT / "src" / "faststrip"

# What only the laboratory says, its modules' names and its commands, and where it reads.
LABORATORY = ("faststrip_lab", "fuzz", "bench", "trade", "scenes", "reference/", "example/")


def laboratory_words(path):
    """Those of them that stand in a file; modules are compressed."""
    data = path.read_bytes()
    text = (gzip.decompress(data) if path.suffix == ".mod" else data).decode("latin-1")
    return {word for word in LABORATORY if word in text}


def subcommands(program):
    return re.findall(r"^  ([a-z]+) ", command(program, "--help"), re.MULTILINE)


def command(*words):
    return subprocess.run([str(word) for word in words], stdout=subprocess.PIPE, encoding="utf-8",
                          check=True).stdout


def umbrella():
    """Module and name of all that `use faststrip` gives."""
    text = re.sub(r"!.*", "", (CORE / "faststrip.f90").read_text(encoding="utf-8"))
    return [(module, name) for module, only in
            re.findall(r"(?m)^ *use (\w+), only: (.*)$", re.sub(r"&\s*\n\s*", "", text))
            for name in re.findall(r"\w+", only)]


def modules_beside():
    """The modules that the head of the umbrella lists."""
    text = (CORE / "faststrip.f90").read_text(encoding="utf-8")
    return set(re.findall(r"faststrip_\w+", "\n".join(re.findall(r"(?m)^!>.*$", text))))


def public_of(module):
    for path in CORE.rglob("*.f90"):
        text = re.sub(r"&\s*\n\s*", "", re.sub(r"!.*", "", path.read_text(encoding="utf-8")))
        if re.search(rf"(?m)^module {module}\s*$", text):
            return {name for names in re.findall(r"(?m)public :: (.*)$", text)
                    for name in re.findall(r"\w+", names)}
    return set()


class Installed(HostTest):
    def setUp(self):
        with open(ROOT / "fpm.toml", "rb") as file:
            self.version = tomllib.load(file)["version"]

    def exported(self):
        names = {}
        for line in command("nm", "-D", "--defined-only", self.installed.library).splitlines():
            name, _, version = line.split()[-1].partition("@@")
            names[name] = version
        return names

    def test_everything_is_in_its_place(self):
        prefix = self.installed.prefix
        for name in ("bin/faststrip", "include/faststrip.h", "include/faststrip/faststrip.mod",
                     "lib/libfaststrip.a", "lib/libfaststrip.so", "lib/libfaststrip.so.0",
                     f"lib/libfaststrip.so.{self.version}", "lib/pkgconfig/faststrip.pc",
                     "lib/cmake/faststrip/faststripConfig.cmake",
                     "lib/cmake/faststrip/faststripConfigVersion.cmake",
                     "lib/faststrip/faststrip_netcdf.so", "share/man/man1/faststrip.1",
                     "share/doc/faststrip/LICENSE"):
            with self.subTest(name):
                self.assertTrue((prefix / name).is_file())
        self.assertTrue((prefix / "bin/faststrip").stat().st_mode & stat.S_IXUSR)
        self.assertTrue(self.installed.library.is_symlink())

    def test_the_library_needs_lapack_and_the_fortran_run_time_only(self):
        text = command("readelf", "-dW", self.installed.library)
        needed = set(re.findall(r"NEEDED.*\[([\w-]+)\.so", text))
        self.assertEqual(needed - NEEDED, set())
        self.assertIn("libopenblas", needed)
        self.assertIn("[libfaststrip.so.0]", text)

    def test_nothing_of_gsl_and_fftw_is_in_the_libraries(self):
        for path in (self.installed.library, self.installed.archive):
            with self.subTest(path.name):
                text = command("nm", *(["-D"] if path.suffix == ".so" else []), path)
                self.assertEqual([line for line in text.splitlines() if FORBIDDEN.search(line)], [])
                # The library has no unit of Fortran's, and does not end its host. (Numbers are read
                # from texts; profiles are read by the C library, which writes nothing.)
                self.assertNotRegex(text, r" U .*(_st_(open|inquire|close)\b|_stop_|\bexit\b"
                                          r"|\b(fwrite|fdopen|rename|remove|unlink)\b)")
        # The test can fail: the program needs both.
        whole = command("nm", "-D", self.installed.prefix / "bin" / "faststrip")
        self.assertRegex(whole, "gsl_integration")
        self.assertRegex(whole, "fftw_")

    def test_nothing_of_the_laboratory_is_installed(self):
        for path in sorted(self.installed.prefix.rglob("*")):
            name = path.relative_to(self.installed.prefix).as_posix()
            self.assertNotRegex(name, r"\blab\b|bench|fuzz|\.csv$|\.nml$")
            if path.is_file():
                with self.subTest(name):
                    self.assertEqual(laboratory_words(path), set())
        # The words are those that its own program has.
        self.assertEqual(laboratory_words(ROOT / "bin" / "faststrip-lab"), set(LABORATORY))

    def test_the_installed_program_refuses_what_the_laboratory_does(self):
        program = self.installed.prefix / "bin" / "faststrip"
        laboratory = subcommands(ROOT / "bin" / "faststrip-lab")
        self.assertLessEqual({"bench", "fuzz", "errata"}, set(laboratory))
        self.assertEqual(set(laboratory) & set(subcommands(program)), set())
        for name in laboratory:
            done = subprocess.run([program, name], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                  encoding="utf-8", check=False)
            with self.subTest(name):
                self.assertEqual((done.returncode, done.stdout), (2, ""))
                self.assertIn(name, done.stderr)

    def test_only_public_names_are_exported(self):
        names = self.exported()
        names.pop("FASTSTRIP_0.1", None)
        header = self.installed.header.read_text(encoding="utf-8")
        header = re.sub(r"/\*.*?\*/", "", header, flags=re.DOTALL)
        declared = set(re.findall(r"^int (faststrip_\w+)\(", header, re.MULTILINE))
        fortran = {name for name in names if "_MOD_" in name}
        self.assertEqual(set(names) - fortran,
                         declared | F77_NAMES | {f"{name}_" for name in F77_NAMES})
        # Of types the tables of their procedures, and what a host's own methods inherit.
        inherited = {name for last in ("method", "capacity") for name in re.findall(
            r"procedure :: \w+ => (\w+)",
            (ROOT / f"src/faststrip/contact/method/{last}.f90").read_text(encoding="utf-8"))}
        self.assertGreater(len(inherited), 4)
        given = set(umbrella()) | {(module, name) for module in modules_beside()
                                   for name in public_of(module)}
        for symbol in fortran:
            module, name = symbol.removeprefix("__").split("_MOD_")
            name = name.removeprefix(f"__vtab_{module}_").lower()
            if name not in inherited:
                self.assertIn((module, name), given)
        self.assertIn("__faststrip_contact_solve_MOD_solve_contact", fortran)
        static = {line.split()[2] for line in
                  command("nm", "--defined-only", "--extern-only",
                           self.installed.archive).splitlines()
                  if len(line.split()) == 3}
        self.assertEqual(static, set(names))

    def test_every_procedure_of_the_umbrella_can_be_linked(self):
        made = set()
        for path in CORE.rglob("*.f90"):
            made |= set(re.findall(r"(?m)^ {4}(?!end\b)[^!\n]*\b(?:subroutine|function) (\w+)",
                                   path.read_text(encoding="utf-8")))
        shown = {name.split("_MOD_")[1] for name in self.exported() if "_MOD_" in name}
        names = {name for _, name in umbrella()}
        self.assertGreater(len(names & made), 20)
        self.assertEqual((names & made) - shown, set())

    def test_the_umbrella_is_small_and_each_name_is_in_an_example(self):
        names = [name for _, name in umbrella()]
        self.assertEqual(len(names), len(set(names)))
        self.assertLessEqual(len(names), 100)
        examples = " ".join(re.sub(r"!.*", "", path.read_text(encoding="utf-8"))
                            for path in (ROOT / "example").rglob("*.f90"))
        self.assertEqual([name for name in names if not re.search(rf"\b{name}\b", examples)], [])

    def test_modules_beside_the_umbrella_are_there(self):
        self.assertGreater(len(modules_beside()), 20)
        for module in modules_beside():
            with self.subTest(module):
                self.assertTrue(public_of(module))
                path = self.installed.prefix / "include" / "faststrip" / f"{module}.mod"
                self.assertTrue(path.exists())

    def test_symbols_have_a_version_and_the_stack_is_not_executable(self):
        versions = set(version for name, version in self.exported().items()
                       if not name.startswith("FASTSTRIP_"))
        self.assertEqual(versions, {"FASTSTRIP_0.1"})
        segment = re.search(r"GNU_STACK.*", command("readelf", "-lW", self.installed.library))[0]
        self.assertNotIn("E", segment.split()[-2])
        members = command("readelf", "-SW", self.installed.archive)
        self.assertNotRegex(members, r"GNU-stack.* X ")

    def test_one_version_everywhere(self):
        """It stands in fpm.toml; what cannot read it there agrees."""
        version = re.escape(self.version)
        texts = {
            "include/faststrip.h": rf'FASTSTRIP_VERSION "{version}"',
            "src/faststrip/interop/c/c.f90": rf"version = '{version}'",
            "python/faststrip/__init__.py": rf'(?m)^__version__ = "{version}"$',
            "CITATION.cff": rf"(?m)^version: {version}$",
        }
        for name, pattern in texts.items():
            with self.subTest(name):
                self.assertRegex((ROOT / name).read_text(encoding="utf-8"), pattern)
        self.assertEqual(self.shell("pkg-config --modversion faststrip").strip(), self.version)
        self.assertRegex(command(self.installed.prefix / "bin" / "faststrip", "--version"),
                         rf"^faststrip {version}\b")

    def test_no_other_file_names_a_version(self):
        """CMakeLists.txt reads fpm.toml, and the packages above the core have no version."""
        named = re.compile(r"(?i)version\w*\W+\d+\.\d+\.\d+")
        found = set()
        for path in (*ROOT.glob("*.*"), *ROOT.glob("src/**/*.*"), *ROOT.glob("app/**/*.*"),
                     *ROOT.glob("include/*"), *ROOT.glob("python/**/*.*"), *ROOT.glob("docs/*.md"),
                     *ROOT.glob("test/fpm.toml")):
            name = path.relative_to(ROOT).as_posix()
            # The page of measurements tells which version was measured, a generated module which
            # was built.
            if (path.is_file() and "build/" not in name
                    and name not in ("docs/validation.md", "app/command/revision.f90")
                    and ".egg-info" not in name
                    and path.suffix in (".f90", ".toml", ".txt", ".h", ".c", ".py", ".cff", ".md")
                    and named.search(path.read_text(encoding="utf-8"))):
                found.add(name)
        self.assertEqual(found, {
            "fpm.toml", "include/faststrip.h", "src/faststrip/interop/c/c.f90",
            "python/faststrip/__init__.py", "CITATION.cff"})

    def test_pkg_config_knows_the_flags(self):
        flags = self.shell("pkg-config --cflags --libs faststrip")
        self.assertIn(f"-I{self.installed.prefix}/include", flags)
        self.assertIn("-lfaststrip", flags)
        self.assertNotRegex(flags, FORBIDDEN)

    def test_the_structs_have_the_members_of_the_header_in_their_order(self):
        header = re.sub(r"/\*.*?\*/", "", self.installed.header.read_text(encoding="utf-8"),
                        flags=re.DOTALL)
        types = {"size_t": "c_size_t", "int": "c_int", "double": "c_double",
                 "const double *": "c_ptr"}
        for room, of_header, of_fortran in (
                ("structs", "case", "case"), ("structs", "result", "result"),
                ("wheelset", "wheelset_demand", "demand"),
                ("wheelset", "wheelset_contact", "contact"),
                ("wheelset", "rail_state", "rail")):
            body, = re.findall(rf"typedef struct faststrip_{of_header} {{(.*?)}}", header,
                               re.DOTALL)
            wanted = [(types[kind], name) for kind, names in
                      re.findall(r"(size_t|int|const double \*|double) ?([\w\[\], ]+);", body)
                      for name in re.findall(r"(\w+)(?:\[\d\])?", names)]
            source = (ROOT / f"src/faststrip/interop/c/{room}.f90").read_text("utf-8")
            body, = re.findall(rf"type, bind\(c\) :: c_{of_fortran}_t\n(.*?)end type", source,
                               re.DOTALL)
            body = re.sub(r"!.*|&\n| = c_null_ptr", "", body)
            found = [(kind, name) for kind, names in
                     re.findall(r"\((c_\w+)\)[^:]* :: (.*)", body)
                     for name in re.findall(r"([a-z]\w*)(?: = 0)?(?:\(\d\))?", names)]
            self.assertEqual(found, wanted, of_header)

    def test_statuses_are_the_same_in_every_face(self):
        source = (ROOT / "src" / "faststrip" / "base" / "status.f90").read_text(encoding="utf-8")
        codes = {name: int(code) for name, code in
                 re.findall(r"integer, parameter :: st_(\w+) = (\d+)", source)}
        # Of writers and quadrature, which are not in the installed library.
        outside = {"quadrature", "file_write"}
        core = {name: code for name, code in codes.items() if name not in outside}
        header = self.installed.header.read_text(encoding="utf-8").split("};")[0]
        found = {name.lower(): int(code) for name, code in
                 re.findall(r"^    FASTSTRIP_([A-Z_]+) = (\d+)", header, re.MULTILINE)}
        self.assertEqual(found.pop("first_error"), 100)
        self.assertEqual(found, core)
        self.assertIn("faststrip_base_status", modules_beside())

    def test_methods_are_the_same_in_every_face(self):
        path = ROOT / "src" / "faststrip" / "contact" / "methods.f90"
        source = path.read_text(encoding="utf-8")
        header = self.installed.header.read_text(encoding="utf-8")
        package = (ROOT / "python" / "faststrip" / "_contact.py").read_text(encoding="utf-8")
        f77 = (ROOT / "src/faststrip/interop/f77/f77.f90").read_text(encoding="utf-8")
        for kind, option in (("normal", 1), ("tangential", 2)):
            core = {name: int(number) for name, number in
                    re.findall(rf"integer, parameter :: {kind}_(\w+) = (\d+)", source)}
            self.assertGreater(len(core), 2)
            found = re.findall(rf"FASTSTRIP_{kind.upper()}_(\w+) = (\d+)", header)
            self.assertEqual({name.lower(): int(number) for name, number in found}, core)
            listed = re.search(rf"^{kind.upper()} = (\{{.*?\}})", package, re.M | re.S)[1]
            python = ast.literal_eval(listed)
            self.assertEqual({name.replace("-", "_"): number for name, number in python.items()},
                             core)
            words = re.search(rf"IOPT\({option}\) {kind} method: (.*?)IOPT", f77, re.S)[1]
            found = re.findall(r"(\d+) ([\w-]+)", words)
            self.assertEqual({name: int(number) for number, name in found}, python)

    def test_the_man_page_names_every_subcommand(self):
        page = self.installed.prefix / "share" / "man" / "man1" / "faststrip.1"
        text = page.read_text(encoding="utf-8")
        listed = subcommands(self.installed.prefix / "bin" / "faststrip")
        self.assertGreater(len(listed), 4)
        for name in listed:
            self.assertIn(f".SS {name}\n", text)
        if shutil.which("man"):
            done = subprocess.run(["man", "--warnings", "-l", str(page)], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, encoding="utf-8", check=True)
            self.assertEqual(done.stderr, "")
            self.assertIn("--strips-per-patch", done.stdout)

    def completed(self, *words):
        """What bash offers for the last of the words of a line."""
        script = self.installed.prefix / "share" / "bash-completion" / "completions" / "faststrip"
        line = ' '.join(f"'{word}'" for word in words)
        # `compopt` is for bash's own calls alone.
        return command("bash", "-euc", f". '{script}'; compopt() {{ :; }}; COMP_WORDS=({line}); "
                       f"COMP_CWORD={len(words) - 1}; _faststrip || :; "
                       'printf "%s\\n" "${COMPREPLY[@]}"').split()

    def test_bash_completes_commands_options_and_methods(self):
        program = self.installed.prefix / "bin" / "faststrip"
        commands = subcommands(program)
        self.assertEqual(self.completed("faststrip", ""), [*commands, "--version"])
        for name in commands:
            options = re.findall(r"^  (-\S+)", command(program, name, "--help"), re.MULTILINE)
            self.assertEqual(self.completed("faststrip", name, "-"), options)
        self.assertEqual(self.completed("faststrip", "contact", "--normal", "kp"),
                         ["kpec", "kpec_strips"])
        self.assertIn("join", self.completed("faststrip", "lookup", ""))
        self.assertEqual(self.completed("faststrip", "lookup", "make", "--th"), ["--threads"])
        # Files are bash's own.
        self.assertEqual(self.completed("faststrip", "contact", "-o", ""), [])
        self.assertEqual(self.completed("faststrip", "contact", ""), [])

    def test_other_shells_know_the_same_commands_and_options(self):
        share = self.installed.prefix / "share"
        program = self.installed.prefix / "bin" / "faststrip"
        zsh = (share / "zsh" / "site-functions" / "_faststrip").read_text(encoding="utf-8")
        fish = (share / "fish" / "vendor_completions.d" / "faststrip.fish").read_text(
            encoding="utf-8")
        for name in subcommands(program):
            self.assertIn(f"'{name}')\n", zsh)
            self.assertIn(f" -f -a {name} -d '", fish)
            of_zsh = zsh.split(f"'{name}')\n")[1].split(" ;;\n")[0]
            for flag in re.findall(r"^  (-\S+)", command(program, name, "--help"), re.MULTILINE):
                self.assertIn(f"'{flag}[", of_zsh)
                long = re.escape(flag.lstrip("-"))
                self.assertRegex(fish, rf"from {name}(; and not .*)?' -[ls] {long} ")
        for shell, path in (("zsh", share / "zsh/site-functions/_faststrip"),
                            ("fish", share / "fish/vendor_completions.d/faststrip.fish")):
            if shutil.which(shell):
                command(shell, "-n", path)

    def test_wrong_usage_is_refused(self):
        for words in ((), ("--prefix",), ("--prefix", ""), ("/usr",)):
            done = subprocess.run([ROOT / "run", "install", *words], stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE, encoding="utf-8", check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("--prefix FOLDER", done.stderr)
