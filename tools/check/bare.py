#!/usr/bin/env python3
"""Run the README's commands in a bare Debian 12, as root and as a user without rights.

    bare.py [--text TEXT] FOLDER

FOLDER is made by debootstrap, unless it is there: Debian's smallest system, with neither git nor
compiler. The files of the checkout are laid into root's home, which is closed to others, and
`./run demo` and `./run test` run there: they install what they need. Then the files are laid into
the home of a user without rights, for whom the packages are there, and both run again. With --text
only `./run test TEXT` runs. Of this machine the network's settings are taken along, with those of
apt and pip. /proc and /dev are seen in a namespace of its own, which ends with the command. Prints
at the end what each command came to; exit 1 if one failed, 2 where it cannot be tried.
"""

import argparse
import os
import pathlib
import platform
import shlex
import shutil
import subprocess
import sys

import lint

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "building"))
import debian  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
# Debian 12, the oldest release that ./run needs.
SUITE = "bookworm"
USER = "tester"
NETWORK = ("etc/resolv.conf", "etc/hosts", "etc/pip.conf", "etc/ssl/certs/ca-certificates.crt",
           "usr/local/share/ca-certificates")
# Of another release than SUITE apt's lists would be wrong.
APT = ("etc/apt/sources.list", "etc/apt/sources.list.d", "etc/apt/apt.conf.d", "etc/apt/keyrings",
       "etc/apt/trusted.gpg.d", "etc/apt/preferences.d", "usr/share/keyrings")
# What apt would ask after each package, of programs that are not there.
HOOKS = ("20packagekit", "50appstream", "docker-")
CERTIFICATES = "/etc/ssl/certs/ca-certificates.crt"
# A shell line: the folder, the user and what it runs are its words.
ENTER = ('mount --rbind /proc "$0/proc" && mount --rbind /dev "$0/dev"'
         ' && exec chroot "--userspec=$1:$1" "$0" /bin/sh -c "$2"')


class Impossible(Exception):
    """Why a bare machine cannot be had here, in one line."""


def last_line(text):
    return (text.strip().splitlines() or ["no word was said"])[-1]


def need(folder):
    """What a bare machine takes; the folder with Debian in it."""
    if os.geteuid() != 0:
        raise Impossible("only root can make a bare machine")
    done = subprocess.run(["unshare", "--mount", "true"], capture_output=True, encoding="utf-8",
                          check=False)
    if done.returncode != 0:
        raise Impossible(f"no namespace of mounts here: {last_line(done.stderr)}")
    if (folder / "bin" / "sh").exists():
        return
    if not shutil.which("debootstrap"):
        why = debian.install("debootstrap")
        if why:
            raise Impossible(f"no debootstrap: {why}")
    print(f"\n== making Debian's {SUITE} in {folder}: two minutes", flush=True)
    folder.mkdir(parents=True, exist_ok=True)
    done = subprocess.run(["debootstrap", "--variant=minbase", SUITE, folder],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8",
                          check=False)
    if done.returncode != 0:
        # Half made it would be taken for whole.
        shutil.rmtree(folder, ignore_errors=True)
        raise Impossible(f"debootstrap: {last_line(done.stdout)}")


def take_along(folder):
    """What leads from this machine to the network."""
    about = platform.freedesktop_os_release()
    names = NETWORK + (APT if about.get("VERSION_CODENAME") == SUITE else ())
    for name in names:
        source, target = pathlib.Path("/", name), folder / name
        if name in APT[:2] and target.is_file():
            target.unlink()
        files = [path for path in (source, *source.rglob("*")) if path.is_file()]
        for path in files:
            if not any(hook in path.name for hook in HOOKS):
                copy = target / path.relative_to(source)
                copy.parent.mkdir(parents=True, exist_ok=True)
                copy.unlink(missing_ok=True)
                shutil.copyfile(path, copy)


def lay_files(folder, home):
    """The files of the checkout, as they are, into a fresh folder of a home."""
    place = folder / home.lstrip("/") / "faststrip"
    shutil.rmtree(place, ignore_errors=True)
    for name in lint.sources(ROOT):
        (place / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(ROOT / name, place / name)


def run_inside(folder, user, line):
    """Run a line of shell in the bare machine; its exit code, and the last line it printed."""
    home = "/root" if user == "root" else f"/home/{user}"
    environment = {"HOME": home, "TERM": "dumb", "LC_ALL": "C.UTF-8",
                   "PATH": "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"}
    if (folder / CERTIFICATES.lstrip("/")).exists():
        environment |= {"SSL_CERT_FILE": CERTIFICATES, "PIP_CERT": CERTIFICATES}
    environment |= {name: os.environ[name] for name in ("http_proxy", "https_proxy", "no_proxy")
                    if name in os.environ}
    words = ["unshare", "--mount", "sh", "-c", ENTER, folder, user, line]
    last = ""
    with subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, encoding="utf-8", errors="replace",
                          env=environment) as process:
        try:
            for told in process.stdout:
                print(told, end="", flush=True)
                last = told.strip() or last
        except BaseException:
            process.kill()
            raise
    return process.returncode, last


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--text", metavar="TEXT")
    parser.add_argument("folder", type=pathlib.Path, metavar="FOLDER")
    options = parser.parse_args()
    folder = options.folder.absolute()
    try:
        need(folder)
    except Impossible as why:
        print(f"bare: {why}", file=sys.stderr)
        return 2
    take_along(folder)
    commands = ["./run demo", "./run test"]
    if options.text is not None:
        commands = [f"./run test {shlex.quote(options.text)}"]
    results = []
    for user, home in (("root", "/root"), (USER, f"/home/{USER}")):
        if user != "root":
            run_inside(folder, "root", f"id {user} >/dev/null 2>&1 || useradd --create-home {user}")
        lay_files(folder, home)
        # Nobody else enters root's home.
        own = f"chown -R {user}: {home}; chmod 700 {home}"
        run_inside(folder, "root", own)
        for command in commands:
            print(f"\n== {user}: {command}", flush=True)
            code, last = run_inside(folder, user, f"cd {home}/faststrip && {command}")
            results.append((user, command, code, last))
    print("\n== in a bare Debian 12")
    for user, command, code, last in results:
        word = "green" if code == 0 else f"exit code {code}"
        print(f"{user:7} {command:20} {word:13} {last}")
    return 1 if any(code for _, _, code, _ in results) else 0


if __name__ == "__main__":
    sys.exit(main())
