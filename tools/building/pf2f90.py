#!/usr/bin/env python3
"""Translate pFUnit test files (.pf) to Fortran, with a program that runs them.

    pf2f90.py [--source test/pf] [--target build/tests]

Every SOURCE/<room>/test_<thing>.pf becomes TARGET/generated_<room>_test_<thing>.f90, and
TARGET/generated_runner.f90 calls them all. What tests share, SOURCE/support/*.f90, comes with
them. A generated file is written only when its content changes, and generated files without a
source are removed.

What is understood, each directive alone on its line:

    @test       before a subroutine without arguments: a test, run in order of appearance
    @disable    directly after @test: count the test as skipped
    @before     before a subroutine without arguments: run before each test of the file
    @after      likewise: run after each test whose @before threw nothing
    @assert...  one of the assertions of test/funit/funit.f90; returns from the routine if it fails

Anything else that starts with @ is refused with file and line, so that a test is never dropped in
silence. As with pFUnit, a file holds one module that has the file's name. Line markers in the
generated code make the compiler and backtraces name the lines of the .pf file.
"""

import argparse
import pathlib
import re
import sys

# Assertion -> number of its operands (a tolerance and a message may follow).
ASSERTIONS = {
    "assertTrue": 1,
    "assertFalse": 1,
    "assertEqual": 2,
    "assertRelativelyEqual": 3,
    "assertGreaterThan": 2,
    "assertGreaterThanOrEqual": 2,
    "assertLessThan": 2,
    "assertLessThanOrEqual": 2,
    "assertIsNaN": 1,
    "assertIsFinite": 1,
    "assertExceptionRaised": 0,
}
MAX_COLUMNS = 120  # so that the translated line stays within Fortran's 132

MODULE = re.compile(r"\s*module\s+(\w+)\s*(!.*)?$", re.IGNORECASE)
SUBROUTINE = re.compile(r"\s*subroutine\s+(\w+)\s*(\(\s*\))?\s*(!.*)?$", re.IGNORECASE)
DIRECTIVE = re.compile(r"\s*@(\w*)(.*)$")
BLANK = re.compile(r"\s*(!.*)?$")


class Refused(Exception):
    """A .pf file that is not understood; the text names file and line."""


class Test:
    def __init__(self, line):
        self.line = line
        self.name = None
        self.disabled = False


def split_arguments(text):
    """Arguments of a call without its parentheses; None if brackets or quotes do not close."""
    arguments, start, closers, quote = [], 0, [], None
    for i, c in enumerate(text):
        if quote:
            if c == quote:
                quote = None
        elif c in "'\"":
            quote = c
        elif c in "([":
            closers.append(")" if c == "(" else "]")
        elif c in ")]":
            if not closers or closers.pop() != c:
                return None
        elif c == "," and not closers:
            arguments.append(text[start:i].strip())
            start = i + 1
        elif c in "!&;":
            return None
    if quote or closers:
        return None
    last = text[start:].strip()
    if arguments or last:
        arguments.append(last)
    return arguments


def use_lines(module, names):
    lines = [f"    use {module}, only: &"]
    return lines + [f"        {name}, &" for name in names[:-1]] + [f"        {names[-1]}"]


class Translation:
    """One .pf file: its Fortran text, its tests and what runs around them."""

    def __init__(self, path, shown, room):
        self.shown = shown
        self.name = path.stem
        self.title = f"{room}/{self.name}" if room else self.name
        self.tests = []
        self.before = None
        self.after = None
        self.lines = []
        self.translate(path.read_text(encoding="utf-8").splitlines())

    def refuse(self, line, why):
        raise Refused(f"{self.shown}:{line}: {why}")

    def translate(self, source):
        module = None
        pending = None  # the Test, or 'before'/'after', whose subroutine is still to come
        self.mark(1)
        for number, line in enumerate(source, start=1):
            directive = DIRECTIVE.match(line)
            if directive:
                pending = self.directive(number, line, directive[1], directive[2], pending)
                continue
            self.lines.append(line)
            if module is None and MODULE.match(line):
                module = MODULE.match(line)[1]
                if module.lower() != self.name.lower():
                    self.refuse(number, f"module {module} is not named as its file")
            if pending is None or BLANK.match(line):
                continue
            subroutine = SUBROUTINE.match(line)
            if not subroutine:
                self.refuse(number, "a subroutine without arguments has to follow the directive")
            self.claim(number, subroutine[1], pending)
            pending = None
        if pending is not None:
            self.refuse(len(source), "no subroutine follows the last directive")
        if module is None:
            self.refuse(1, "there is no module")
        if not self.tests:
            self.refuse(1, "there is no @test")

    def directive(self, number, line, name, rest, pending):
        if name in ("test", "before", "after", "disable"):
            if rest.strip():
                self.refuse(number, f"@{name} takes nothing after it: {rest.strip()}")
            self.lines.append("")
            if name == "disable":
                if not isinstance(pending, Test) or pending.disabled:
                    self.refuse(number, "@disable has to follow @test")
                pending.disabled = True
                return pending
            if pending is not None:
                self.refuse(number, f"@{name} where a subroutine has to follow")
            if name != "test" and getattr(self, name) is not None:
                self.refuse(number, f"a second @{name}")
            return Test(number) if name == "test" else name
        if name not in ASSERTIONS:
            self.refuse(number, f"unknown directive @{name}")
        if pending is not None:
            self.refuse(number, f"@{name} where a subroutine has to follow")
        self.assertion(number, line, name, rest)
        return None

    def assertion(self, number, line, name, rest):
        call = rest.strip()
        arguments = None
        if call.startswith("(") and call.endswith(")"):
            arguments = split_arguments(call[1:-1])
        if arguments is None or "" in arguments:
            self.refuse(number, f"@{name} is not one whole call on one line")
        if len(arguments) < ASSERTIONS[name]:
            self.refuse(number, f"@{name} needs at least {ASSERTIONS[name]} arguments")
        if any(re.match(r"location\s*=[^=]", a, re.IGNORECASE) for a in arguments):
            self.refuse(number, f"@{name} gets its location from the translator")
        if len(line.rstrip()) > MAX_COLUMNS:
            self.refuse(number, f"@{name} is longer than {MAX_COLUMNS} columns")
        indent = line[: len(line) - len(line.lstrip())]
        # A mark before each line, so that whichever the compiler names, it is this one's number.
        for part in (
            f"call {name}({', '.join(arguments + ['&'])}",
            "    location=SourceLocation( &",
            f"    '{self.shown}', {number}))",
            "if (anyExceptions()) return",
        ):
            self.mark(number)
            self.lines.append(indent + part)
        self.mark(number + 1)

    def mark(self, number):
        self.lines.append(f'# {number} "{self.shown}"')

    def claim(self, number, name, pending):
        if isinstance(pending, Test):
            if any(t.name.lower() == name.lower() for t in self.tests):
                self.refuse(number, f"a second test {name}")
            pending.name = name
            self.tests.append(pending)
        else:
            setattr(self, pending, name)

    def suite(self):
        """The module that runs the tests of this file."""
        enabled = [t.name for t in self.tests if not t.disabled]
        around = [name for name in (self.before, self.after) if name and enabled]
        runner = ["start_module", "end_module", "is_wanted"]
        runner += ["end_test"] if enabled else []
        runner += ["skip_test"] if len(enabled) < len(self.tests) else []
        lines = [f"module {self.name}_suite"]
        if enabled and self.before:
            lines += use_lines("funit", ["anyExceptions"])
        lines += use_lines("funit_runner", runner)
        if enabled:
            lines += use_lines(self.name, around + enabled)
        lines += ["    implicit none", "    private", "", f"    public :: run_{self.name}", ""]
        lines += ["contains", "", f"    subroutine run_{self.name}()"]
        lines += [f"        call start_module('{self.title}')"]
        for test in self.tests:
            lines += [f"        if (is_wanted('{test.name}')) then"]
            if test.disabled:
                lines += [f"            call skip_test('{test.name}')", "        end if"]
                continue
            body = [f"call {test.name}()"] + ([f"call {self.after}()"] if self.after else [])
            if self.before:
                lines += [f"            call {self.before}()"]
                lines += ["            if (.not. anyExceptions()) then"]
                lines += [f"                {call}" for call in body]
                lines += ["            end if"]
            else:
                lines += [f"            {call}" for call in body]
            lines += [f"            call end_test('{test.name}')", "        end if"]
        lines += ["        call end_module()", f"    end subroutine run_{self.name}"]
        lines += [f"end module {self.name}_suite"]
        return lines

    def text(self):
        head = [f"! Made from {self.shown} by tools/building/pf2f90.py; not to be edited."]
        mark = [f'# 1 "suite of {self.shown}"']
        return "\n".join(head + self.lines + mark + self.suite()) + "\n"


def runner_text(translations):
    lines = ["! Made by tools/building/pf2f90.py; not to be edited.", "program generated_runner"]
    lines += ["    use funit_runner, only: start_run, end_run"]
    lines += [f"    use {t.name}_suite, only: run_{t.name}" for t in translations]
    lines += ["    implicit none", "", "    call start_run()"]
    lines += [f"    call run_{t.name}()" for t in translations]
    lines += ["    call end_run()", "end program generated_runner"]
    return "\n".join(lines) + "\n"


# They run first, so that no process is left alone with one of them at the end.
LONGEST = ("test_cells_invariance", "test_sub_patch_forces")


def translate_all(source):
    """Generated file name -> text."""
    translations = []
    for path in sorted(source.rglob("*.pf"), key=lambda path: (path.stem not in LONGEST, path)):
        shown = path.as_posix()
        if not re.fullmatch(r"test_\w+", path.stem):
            raise Refused(f"{shown}:1: a test file is named test_<thing>.pf")
        room = path.parent.relative_to(source).as_posix()
        translation = Translation(path, shown, "" if room == "." else room)
        twin = [t for t in translations if t.name.lower() == translation.name.lower()]
        if twin:
            raise Refused(f"{shown}:1: {twin[0].shown} has the same module name")
        translations.append(translation)
    files = {f"generated_{t.title.replace('/', '_')}.f90": t.text() for t in translations}
    for path in source.glob("support/*.f90"):
        files[f"generated_support_{path.name}"] = (f'# 1 "{path.as_posix()}"\n'
                                                   + path.read_text(encoding="utf-8"))
    files["generated_runner.f90"] = runner_text(translations)
    return files


def write_all(files, target):
    for old in target.glob("generated_*.f90"):
        if old.name not in files:
            old.unlink()
    for name, text in files.items():
        path = target / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


def main():
    parser = argparse.ArgumentParser(description="Translate pFUnit tests to Fortran.")
    parser.add_argument("--source", type=pathlib.Path, default=pathlib.Path("test/pf"))
    parser.add_argument("--target", type=pathlib.Path, default=pathlib.Path("build/tests"))
    options = parser.parse_args()
    try:
        files = translate_all(options.source)
    except Refused as refusal:
        print(f"pf2f90: {refusal}", file=sys.stderr)
        return 1
    write_all(files, options.target)
    return 0


if __name__ == "__main__":
    sys.exit(main())
