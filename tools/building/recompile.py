#!/usr/bin/env python3
"""Stand for gfortran in fpm's builds: compile a source only if what the compiler sees has changed.

    recompile.py GFORTRAN WORDS...

fpm compiles all that uses a changed module, directly or not. Here an object is kept if the source,
the words, the compiler, and the module files that the source uses are those of its last
compilation, and the module files that this wrote are still there. A comment or the body of a
procedure leaves the module file as it is, so that the users of the module are kept; another
interface does not. What the object was made from stands beside it in OBJECT.seen.

FASTSTRIP_TWIN names folders, parted as those of PATH, in which fpm has built other packages, maybe
of the same sources: an object made of the same there is copied with its module files.

Always compiled are sources that include files, submodules, and what is no .f90. Calls that compile
nothing go to gfortran as they are.
"""

import glob
import hashlib
import os
import re
import sys

# In free form a statement is at the beginning of a line or behind a semicolon.
USE = re.compile(rb"(?:^|;)[ \t]*use\b[ \t]*(?:,[ \t]*\w+[ \t]*)?(?:::)?[ \t]*(\w*)", re.I | re.M)
MODULE = re.compile(rb"(?:^|;)[ \t]*module[ \t]+(\w+)[ \t]*\r?(?:[!;]|$)", re.I | re.M)
# What is seen otherwise than through module files.
OTHER = re.compile(rb"(?:^|;)[ \t]*(?:include\b|submodule\b|module[ \t]*&)", re.I | re.M)


def main(compiler, *words):
    call = parse(words)
    if call is None:
        os.execv(compiler, [compiler, *words])
    source, target, folders = call
    note = f"{target}.seen"
    text = read(source) or b""
    used, made = names(USE, text), names(MODULE, text)
    # A name that stands on the next line is not looked for.
    if not text or OTHER.search(text) or b"" in used:
        remove(note)
        os.execv(compiler, [compiler, *words])
    about = os.stat(compiler)
    what = hashlib.sha256(repr((os.path.realpath(compiler), about.st_size, about.st_mtime_ns,
                                os.path.realpath(source), other_words(words))).encode())
    what.update(text)
    what.update(record(used, folders))
    what = what.hexdigest().encode()
    if os.path.exists(target) and read(note) == b"%b\n%b" % (what, record(made, folders[:1])):
        return 0
    remove(note)
    if copy_twin(what, os.path.basename(source), made, target, folders[0]):
        return 0
    process = os.posix_spawn(compiler, [compiler, *words], os.environ)
    code = os.waitstatus_to_exitcode(os.waitpid(process, 0)[1])
    if code == 0:
        write(note, b"%b\n%b" % (what, record(made, folders[:1])))
    return 128 - code if code < 0 else code


def parse(words):
    """Source, object and the folders of module files, first the one written to; None if this is
    no compilation of one source in free form."""
    source, target, written, others = [], None, None, []
    rest = iter(words)
    for word in rest:
        if word == "-o":
            target = next(rest, None)
        elif word == "-J":
            written = next(rest, None)
        elif word.startswith("-J"):
            written = word[2:]
        elif word == "-I":
            others.append(next(rest, ""))
        elif word.startswith("-I"):
            others.append(word[2:])
        elif word in ("-cpp", "-MD", "-MMD") or word.startswith("@"):
            return None
        elif not word.startswith("-"):
            source.append(word)
    if "-c" not in words or len(source) != 1 or not source[0].endswith(".f90") or not target \
            or not written:
        return None
    return source[0], target, [written, *others]


def other_words(words):
    """The words that name no place: fpm spells places now this way, now that."""
    others, before = [], ""
    for word in words:
        if before not in ("-o", "-J", "-I") and not word.startswith(("-J", "-I")) \
                and not word.endswith(".f90") and word != "-o":
            others.append(word)
        before = word
    return others


def copy_twin(what, source, made, target, folder):
    """Take an object that was made of the same, its module files and its note; is there one?"""
    # fpm names objects of other packages by their way there, with dots ahead, and puts module files
    # one folder above.
    notes = (note for twin in filter(None, os.environ.get("FASTSTRIP_TWIN", "").split(os.pathsep))
             for note in glob.glob(os.path.join(glob.escape(twin), "*", "*", f"*{source}.o.seen"),
                                   include_hidden=True))
    for note in notes:
        place = os.path.dirname(os.path.dirname(note))
        told, found = read(note), read(note.removesuffix(".seen"))
        if found is None or told != b"%b\n%b" % (what, record(made, [place])):
            continue
        for name in made:
            write(os.path.join(folder, name.decode() + ".mod"),
                  read(os.path.join(place, name.decode() + ".mod")))
        write(target, found)
        write(f"{target}.seen", told)
        return True
    return False


def write(path, text):
    with open(f"{path}.new", "wb") as stream:
        stream.write(text)
    os.replace(f"{path}.new", path)


def names(pattern, text):
    return {name.lower() for name in pattern.findall(text)}


def read(path):
    try:
        with open(path, "rb") as stream:
            return stream.read()
    except OSError:
        return None


def remove(path):
    if os.path.exists(path):
        os.remove(path)


def record(modules, folders):
    """Lines that tell the module files of these names; a compiler's own modules have none."""
    lines = {}
    for name in sorted(modules):
        for folder in folders:
            text = read(os.path.join(folder, name.decode() + ".mod"))
            if text is not None:
                lines[f"{name.decode()} {hashlib.sha256(text).hexdigest()}\n"] = True
    return "".join(lines).encode()


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
