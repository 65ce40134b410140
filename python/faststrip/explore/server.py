"""The command ``faststrip-explore``: serves the page on 127.0.0.1, and nowhere else."""

from __future__ import annotations

import argparse
import dataclasses
import errno
import logging
import signal
import sys
import warnings
from typing import Any, List, Optional

from .._library import FaststripError, ImplausibleWarning

PORT = 5173
HOST = "127.0.0.1"
MOST_PORTS = 65535
MOST_BYTES = 20 * 1024 * 1024  # of a message: an uploaded file


def parser() -> argparse.ArgumentParser:
    """What the command takes."""
    made = argparse.ArgumentParser(
        prog="faststrip-explore",
        description="Serve the interactive explorer: one wheel on one rail, or a wheelset on its "
                    "track, solved while sliders move. It is served on 127.0.0.1 only and "
                    "loads nothing from the network. Ctrl-C ends it.",
        epilog="Units mm, N, rad. Forces act on the rail. More: docs/usage.md.")
    made.add_argument("files", metavar="FILE", nargs="*", help="a case file, CASE.nml, or the "
                      "profiles of a wheel and of a rail, in this order")
    made.add_argument("--wheel", metavar="PROFILE", help="s1002 (default), cone20, cone40 or a "
                      "file of any format that 'faststrip profile' reads")
    made.add_argument("--rail", metavar="PROFILE", help="uic60 (default), 60e1, 54e1 or a file")
    made.add_argument("--case", metavar="CASE.nml", help="begin with this case file: profiles, "
                      "shift, vertical or normal load, creepages, friction")
    made.add_argument("--inclination", type=float, metavar="TANGENT", help="inclination of the "
                      "first rail, 0.025 for 1:40 (default: 1:40 of a name, a file as it lies)")
    made.add_argument("--port", type=int, default=PORT, metavar="N",
                      help=f"port of the page (default {PORT}; 0: any that is free)")
    made.add_argument("--no-browser", action="store_true", help="open no browser")
    return made


def main(words: Optional[List[str]] = None) -> int:
    """Serve the page until Ctrl-C; the exit code."""
    options = parser().parse_args(words)
    from .case import Case, CaseError, checked, find_shape

    try:
        from . import casefile, page
    except ModuleNotFoundError as problem:
        if (problem.name or "").partition(".")[0] not in ("bokeh", "tornado", "f90nml"):
            raise
        print(f"faststrip-explore: {problem.name} is missing: pip install 'faststrip[explore]' "
              "(or bokeh f90nml)", file=sys.stderr)
        return 1
    try:
        take_files(options)
        case = casefile.read_case(options.case) if options.case else Case()
        if options.wheel is not None:
            case = dataclasses.replace(case, wheel=find_shape("wheel", options.wheel))
        if options.rail is not None:
            case = dataclasses.replace(case, rail=find_shape("rail", options.rail))
        if options.inclination is not None:
            case = dataclasses.replace(case, given_inclination=options.inclination)
        checked(case)
    except (CaseError, FaststripError) as problem:
        print(f"faststrip-explore: {problem}", file=sys.stderr)
        return 1
    return serve(lambda document: page.Page(document, case), options.port,
                 not options.no_browser)


def take_files(options: argparse.Namespace) -> None:
    """Files that are given without an option, as if by their options; else CaseError."""
    from .case import CaseError

    files = options.files
    names = ("case",) if len(files) == 1 else ("wheel", "rail")
    if len(files) > len(names):
        raise CaseError(f"one case file or a wheel and a rail can be opened, got {len(files)} "
                        f"files: {' '.join(files)}")
    if len(files) == 1 and not files[0].lower().endswith(".nml"):
        raise CaseError("one file alone must be a case file, CASE.nml; profiles are opened by "
                        f"WHEEL RAIL, --wheel or --rail, got {files[0]}")
    for name, file in zip(names, files):
        if getattr(options, name) is not None:
            raise CaseError(f"--{name} must not be given with {file}")
        setattr(options, name, file)


def serve(fill: Any, port: int, with_browser: bool) -> int:
    """Serve documents that are filled in for each tab."""
    from bokeh.application import Application
    from bokeh.application.handlers.function import FunctionHandler
    from bokeh.server.server import Server

    from .look import TEMPLATE

    # The page says which pressures yield.
    warnings.simplefilter("ignore", ImplausibleWarning)
    logging.getLogger("bokeh").setLevel(logging.ERROR)
    logging.getLogger("tornado.access").setLevel(logging.CRITICAL)

    def prepare(document: Any) -> None:
        document.template = TEMPLATE
        fill(document)

    if not 0 <= port <= MOST_PORTS:
        print(f"faststrip-explore: {HOST}:{port}: the port must be from 0 to {MOST_PORTS}",
              file=sys.stderr)
        return 1
    try:
        server = Server(
            {"/": Application(FunctionHandler(prepare))}, address=HOST, port=port,
            websocket_max_message_size=MOST_BYTES, check_unused_sessions_milliseconds=2000,
            unused_session_lifetime_milliseconds=5000)
    except OSError as problem:
        why = ("the port is in use; another with --port N" if problem.errno == errno.EADDRINUSE
               else problem.strerror)
        print(f"faststrip-explore: {HOST}:{port}: {why}", file=sys.stderr)
        return 1
    address = f"http://{HOST}:{server.port}/"
    print(f"faststrip explore: {address} (Ctrl-C ends it)", flush=True)
    server.start()
    if with_browser:
        server.io_loop.add_callback(server.show, "/")

    def end(number: int, frame: Any) -> None:
        server.io_loop.add_callback_from_signal(server.io_loop.stop)

    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, end)
    server.io_loop.start()
    server.stop()
    return 0
