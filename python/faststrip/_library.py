"""The shared library: where it is, what it exports, how its statuses become exceptions."""

from __future__ import annotations

import _thread
import ctypes
import ctypes.util
import functools
import os
import pathlib
import subprocess
import sys
import warnings
from ctypes import POINTER, c_char_p, c_double, c_int, c_size_t, c_void_p
from typing import Any, Iterator, Optional, Tuple

from ._catalogue import Case, Figures

FILE = "libfaststrip.so.0"
TEXT = 257
FIRST_ERROR = 100
BAD_ARGUMENT = 100
NOT_FINITE = 101
NO_CONVERGENCE = 108
TOO_SMALL = 110


class LibraryNotFound(ImportError):
    """There is no libfaststrip where it was looked for."""


class ProgramNotFound(ImportError):
    """There is no program faststrip where it was looked for."""


class FaststripError(Exception):
    """A call without a result.

    ``status`` is its number, ``word`` the word for it (``no_contact``, ``not_finite``, ...), the
    text says which value was wrong.
    """

    def __init__(self, status: int, word: str, message: str = "") -> None:
        super().__init__(f"{word}: {message}" if message else word)
        self.status = status
        self.word = word
        self.message = message

    def __reduce__(self) -> Tuple[Any, ...]:
        # An exception is made anew from its arguments, which are not the text alone.
        return type(self), (self.status, self.word, self.message), self.__dict__


def _pkg_config_folder() -> Optional[str]:
    try:
        done = subprocess.run(["pkg-config", "--variable=libdir", "faststrip"],
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                              encoding="utf-8", check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    return done.stdout.strip() or None


def _candidates() -> Iterator[str]:
    """Where the library may be; what the environment names is not searched past."""
    if "FASTSTRIP_LIBRARY" in os.environ:
        yield os.environ["FASTSTRIP_LIBRARY"]
        return
    if "FASTSTRIP_PREFIX" in os.environ:
        yield str(pathlib.Path(os.environ["FASTSTRIP_PREFIX"]) / "lib" / FILE)
        return
    own = pathlib.Path(__file__).parent / FILE
    if own.exists():  # a wheel
        yield str(own)
        return
    folders = [_pkg_config_folder(), str(pathlib.Path(sys.prefix) / "lib")]
    yield from (str(pathlib.Path(folder) / FILE) for folder in folders if folder)
    yield FILE
    found = ctypes.util.find_library("faststrip")
    if found:
        yield found


def _load() -> ctypes.CDLL:
    tried = []
    for name in _candidates():
        try:
            return ctypes.CDLL(name)
        except OSError as problem:
            tried.append(f"{name} ({problem})")
    raise LibraryNotFound(
        "no libfaststrip: install it with ./run install --prefix FOLDER and set FASTSTRIP_PREFIX "
        "to that folder, or FASTSTRIP_LIBRARY to the file; tried " + ", ".join(tried))


def _declare(library: ctypes.CDLL) -> None:
    handle = c_void_p
    number = c_double
    arguments = {
        "version": [c_char_p, c_size_t],
        "message": [c_int, c_char_p, c_size_t],
        "last_message": [handle, c_char_p, c_size_t],
        "doubt": [handle, c_int, c_char_p, c_size_t],
        "default_case": [POINTER(Case), c_size_t],
        "check_case": [POINTER(Case), c_int, c_char_p, c_size_t],
        "new": [POINTER(Case), c_int, POINTER(handle)],
        "free": [POINTER(handle)],
        "copy": [handle, handle],
        "set_gap": [handle, c_int, *[c_void_p] * 4],
        "solve": [handle, POINTER(Case), POINTER(Figures)],
        "solve_many": [c_size_t, c_void_p, c_int, *[c_void_p] * 2, c_int, c_int, *[c_void_p] * 2,
                       c_char_p, c_size_t],
        "get_derivatives": [handle, c_void_p],
        "get_strips": [handle, c_int, POINTER(c_int), *[c_void_p] * 5],
        "get_elements": [handle, c_int, POINTER(c_int), *[c_void_p] * 9],
        "get_stresses": [handle, c_int, *[c_void_p] * 4],
        "get_stress_peak": [handle, POINTER(number)],
        "get_steps": [handle, c_int, POINTER(c_int), *[c_void_p] * 7],
        "get_wear": [handle, c_void_p, number, POINTER(number)],
        "get_flash": [handle, POINTER(number)],
        "get_temperatures": [handle, c_int, *[c_void_p] * 4],
        "get_strip_wear": [handle, c_void_p, c_int, POINTER(c_int), *[c_void_p] * 6],
        "fastsim": [*[number] * 11, c_int, c_int, POINTER(number)],
        "hertz": [*[number] * 7, POINTER(number)],
        "kalker": [number, number, POINTER(number)],
        "profile_gap": [c_int, *[c_void_p] * 2, c_int, *[c_void_p] * 3, c_int, POINTER(c_int),
                        *[c_void_p] * 5],
        "pair_gap": [*[c_void_p] * 3, c_int, POINTER(c_int), *[c_void_p] * 5, c_char_p, c_size_t],
        "roller_gap": [*[c_void_p] * 3, number, c_int, POINTER(c_int), *[c_void_p] * 5, c_char_p,
                       c_size_t],
        "draw_profile": [c_void_p, c_int, number, c_int, *[c_void_p] * 2, c_char_p, c_size_t],
        "default_reading": [c_void_p, c_size_t],
        "read_profile": [c_char_p, c_void_p, c_int, POINTER(c_int), *[c_void_p] * 3, c_char_p,
                         c_size_t],
        "wheelset_get_gap": [handle, c_int, c_int, POINTER(c_int), *[c_void_p] * 4],
        "wheelset_new": [*[c_void_p] * 3, POINTER(Case), POINTER(handle), c_char_p, c_size_t],
        "wheelset_free": [POINTER(handle)],
        "wheelset_solve": [handle, *[c_void_p] * 2, c_int, POINTER(c_int), *[c_void_p] * 2],
        "wheelset_save": [handle, c_size_t, POINTER(c_size_t), c_void_p],
        "wheelset_restore": [handle, c_size_t, c_void_p],
        "wheelset_get_derivatives": [handle, c_void_p],
        "wheelset_get_strips": [handle, c_int, c_int, POINTER(c_int), *[c_void_p] * 5],
        "wheelset_get_elements": [handle, c_int, c_int, POINTER(c_int), *[c_void_p] * 9],
        "wheelset_get_wear": [handle, c_int, c_void_p, number, POINTER(number)],
        "wheelset_get_flash": [handle, c_int, POINTER(number)],
        "wheelset_get_temperatures": [handle, c_int, c_int, *[c_void_p] * 4],
        "wheelset_get_strip_wear": [handle, c_int, c_void_p, c_int, POINTER(c_int),
                                    *[c_void_p] * 6],
        "contact_functions": [*[c_void_p] * 3, c_int, c_int, *[c_void_p] * 3, c_char_p, c_size_t],
        "conicity": [c_int, *[c_void_p] * 2, c_int, *[c_void_p] * 4, c_char_p, c_size_t],
        "lookup_open": [c_char_p, c_size_t, POINTER(handle), c_char_p, c_size_t],
        "lookup_free": [POINTER(handle)],
        "lookup_about": [handle, POINTER(number)],
        "lookup_forces": [handle, c_int, c_int, *[c_void_p] * 4],
        "lookup_wheel_about": [handle, POINTER(number)],
        "lookup_wheel_z_errors": [handle, POINTER(number)],
        "wheelset_use_lookup": [handle, handle, c_int],
        "lookup_wheel_contacts": [handle, c_int, c_int, *[c_void_p] * 4],
        "lookup_wheel_forces": [handle, c_int, c_int, *[c_void_p] * 5],
        "wheelset_last_message": [handle, c_char_p, c_size_t],
    }
    for name, types in arguments.items():
        try:
            function = getattr(library, f"faststrip_{name}")
        except AttributeError:
            raise LibraryNotFound(f"{library._name} is older than this package: it has no "
                                  f"faststrip_{name}") from None
        function.argtypes = types
        function.restype = c_int


library = _load()
_declare(library)


def said(function: Any, *arguments: Any) -> Tuple[int, str]:
    """Status and words of a call whose last arguments are a text and its size."""
    text = ctypes.create_string_buffer(TEXT)
    status = function(*arguments, text, TEXT)
    return status, text.value.decode("utf-8", "replace")


def told(function: Any, *arguments: Any) -> str:
    """The words of such a call; raises what is an error."""
    status, words = said(function, *arguments)
    if status >= FIRST_ERROR:
        raise FaststripError(status, word_of(status), words)
    return words


@functools.lru_cache(maxsize=None)
def word_of(status: int) -> str:
    """The word of a status."""
    return said(library.faststrip_message, status)[1]


def bad_argument(message: str) -> FaststripError:
    """The error of an argument."""
    return FaststripError(BAD_ARGUMENT, word_of(BAD_ARGUMENT), message)


class Handle:
    """Something of the library, freed with the last that holds it: so not during a call."""

    def __init__(self, free: Any) -> None:
        self.handle = c_void_p()
        self.in_use = _thread.allocate_lock()
        self._free = free

    def __del__(self, byref: Any = ctypes.byref) -> None:
        self._free(byref(self.handle))


def limitation_words(limitations: int) -> Tuple[str, ...]:
    """The words of a set of limitations, ``1 << status`` of each added up.

    Parameters
    ----------
    limitations : int
        As results of many contacts have it.

    Returns
    -------
    tuple of str
        In the order of the statuses.
    """
    return tuple(word_of(status) for status in range(int(limitations).bit_length())
                 if limitations >> status & 1)


def check(status: int, workspace: Optional[c_void_p] = None, **values: Any) -> int:
    """Raise what is an error, with the words of a workspace or else the values of the call; give
    other statuses back."""
    if status < FIRST_ERROR:
        return status
    words = ", ".join(f"{name} = {value!r}" for name, value in values.items())
    if workspace:
        words = said(library.faststrip_last_message, workspace)[1]
    raise FaststripError(status, word_of(status), words)


class ImplausibleWarning(UserWarning):
    """A number that no contact has in practice: mostly a unit. The result is what it says."""


def warn_of_doubts(workspace: c_void_p, stacklevel: int = 3) -> None:
    """Warn of what was outside of practice in the last call of a workspace or a wheelset."""
    for i in range(100):
        words = said(library.faststrip_doubt, workspace, i)[1]
        if not words:
            return
        warnings.warn(words, ImplausibleWarning, stacklevel)


def check_case(case: Case, max_points: int) -> None:
    """Raise what a case without a workspace is refused for."""
    status, words = said(library.faststrip_check_case, ctypes.byref(case), max_points)
    if status >= FIRST_ERROR:
        size = f"strips_per_patch {case.strips_per_patch}, max_points {max_points}"
        if case.with_elements:
            size += (f", with_elements, points_per_strip {case.points_per_strip},"
                     f" fastsim_grid {case.fastsim_nx} x {case.fastsim_ny}")
        raise FaststripError(status, word_of(status), f"{words} ({size})")
