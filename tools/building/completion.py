"""Completion of the program's commands for bash, zsh and fish, from what its --help says.

Commands, options and names of methods are completed, and files where an option takes one.
"""

import dataclasses
import re

from man_page import help_of, subcommands

# An option of one value or none, and what it does: from this line on, those that are indented more.
OPTION = re.compile(r"^  (?P<flag>--?[\w-]+)(?: (?P<value>\S+))?"
                    r"(?P<words>(?: {2,}.*)?(?:\n {12,}.*)*)$", re.MULTILINE)
METHOD = re.compile(r"^  ([a-z_-]+) {2,}", re.MULTILINE)
ACTION = re.compile(r"^  ([a-z]+) .*?  +(.*)$", re.MULTILINE)
FILES = ("FILE", "TABLE")

BASH = """\
# Completion of faststrip for bash, from its --help.
_faststrip()
{{
    local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=
    local command=${{COMP_WORDS[1]}}
    [[ $command = lookup && $COMP_CWORD -gt 2 ]] && command+=" ${{COMP_WORDS[2]}}"
    [[ $COMP_CWORD -eq 1 ]] && command=
    # Names of methods, files, other values, and else options and commands.
    case "$command $before" in
{cases}
    *)  case $command in
{lists}
        esac
        [[ $word = -* || $command = '' || $command = lookup ]] || words= ;;
    esac
    # Without an answer bash completes files.
    COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _faststrip faststrip
"""
ZSH = """\
#compdef faststrip
# Completion of faststrip for zsh, from its --help.
local command=$words[2]
[[ $command = lookup && $CURRENT -gt 3 ]] && command+=" $words[3]"
(( CURRENT == 2 )) && command=
local -a names
case $command in
{commands}
esac
"""
FISH_CHOICE = "complete -c faststrip -n '{when}' {form} -d '{words}'\n"


@dataclasses.dataclass
class Option:
    """One option: flag, what its value is called (or nothing), what it does, names to choose."""

    flag: str
    value: str
    words: str
    names: list

    @property
    def takes_file(self):
        return bool(self.value) and self.value.startswith(FILES)


def listed_methods(text, kind):
    """The names of the list of methods of a kind, where a help has one."""
    found = re.search(rf"^{kind} methods:\n((?:  .*\n)+)", text, re.MULTILINE)
    return METHOD.findall(found[1]) if found else []


def options_of(text):
    """The options of a help; of what each does the words up to a semicolon."""
    found = []
    for match in OPTION.finditer(text):
        words = " ".join(match["words"].split()).split(";")[0]
        names = listed_methods(text, match["flag"][2:])
        found.append(Option(match["flag"], match["value"] or "", words, names))
    return found


def commands_of(program):
    """Commands, those of `lookup` by two words: what each does, and its options. The one without a
    name is the program itself."""
    general = help_of(program)
    about = dict(ACTION.findall(general))
    found = {"": ("", options_of(general))}
    for name in subcommands(general):
        text = help_of(program, name)
        found[name] = (about[name], options_of(text))
        if re.search(r"^  ACTION --help ", text, re.MULTILINE):
            for action, words in ACTION.findall(text):
                found[f"{name} {action}"] = (words, options_of(help_of(program, name, action)))
    return found


def below(commands, name):
    """Words that may follow a command: those of commands, not options."""
    depth = name.count(" ") + 1 if name else 0
    return {each.split()[depth]: about for each, (about, _) in commands.items()
            if each and each.count(" ") == depth and each.startswith(f"{name} ".lstrip())}


def bash(commands):
    cases, files, other, lists = [], [], [], []
    for name, (_, options) in commands.items():
        for option in options:
            pattern = f"'{name} {option.flag}'"
            if option.names:
                cases.append(f"    {pattern}) words='{' '.join(option.names)}' ;;")
            elif option.value:
                (files if option.takes_file else other).append(pattern)
        words = [*below(commands, name), *(option.flag for option in options)]
        lists.append(f"        '{name}') words='{' '.join(words)}' ;;")
    cases.append(f"    {one_a_line(files)}) ;;")
    cases.append(f"    {one_a_line(other)}) compopt +o default ;;")
    return BASH.format(cases="\n".join(cases), lists="\n".join(lists))


def one_a_line(patterns):
    return " | \\\n    ".join(patterns)


def quoted(text):
    """Text between single quotes, for zsh."""
    return "'" + text.replace("'", "'\\''") + "'"


def zsh_option(option):
    ends = f"({' '.join(option.names)})" if option.names else "_files" if option.takes_file else " "
    value = f":{option.value}:{ends}" if option.value else ""
    words = re.sub(r"([\[\]:\\])", r"\\\1", option.words)
    return quoted(f"{option.flag}[{words}]{value}")


def zsh(commands):
    lines = []
    for name, (_, options) in commands.items():
        follow = below(commands, name)
        lines.append(f"{quoted(name)})")
        if follow:
            names = " ".join(quoted(f"{word}:{about}") for word, about in follow.items())
            lines.append(f"    names=({names}); _describe command names")
        level = name.count(" ") + 1 if name else 0
        shift = f"shift {level} words; (( CURRENT -= {level} )); " if level else ""
        files = "" if follow else " '*:file:_files'"
        lines.append(f"    {shift}_arguments {' '.join(map(zsh_option, options))}{files} ;;")
    return ZSH.format(commands="\n".join(lines))


def fish(commands):
    lines = ["# Completion of faststrip for fish, from its --help.\n"]
    for name, (_, options) in commands.items():
        follow = below(commands, name)
        words = name.split()
        when = "; and ".join(f"__fish_seen_subcommand_from {word}" for word in words)
        none_yet = f"not __fish_seen_subcommand_from {' '.join(follow)}"
        if follow:
            when = f"{when}; and {none_yet}" if when else "__fish_use_subcommand"
        for word, about in follow.items():
            lines.append(FISH_CHOICE.format(when=when, form=f"-f -a {word}", words=plain(about)))
        for option in options:
            dashes = "-l" if option.flag.startswith("--") else "-s"
            form = f"{dashes} {option.flag.lstrip('-')}"
            if option.names:
                form += f" -x -a '{' '.join(option.names)}'"
            elif option.value:
                form += " -r -F" if option.takes_file else " -x"
            lines.append(FISH_CHOICE.format(when=when, form=form, words=plain(option.words)))
    return "".join(lines)


def plain(text):
    return text.replace("\\", "\\\\").replace("'", "\\'")


# Where each shell looks below a prefix.
SHELLS = {
    "share/bash-completion/completions/faststrip": bash,
    "share/zsh/site-functions/_faststrip": zsh,
    "share/fish/vendor_completions.d/faststrip.fish": fish,
}


def completions(program):
    """Files below a prefix and what is in them."""
    commands = commands_of(program)
    return {place: write(commands) for place, write in SHELLS.items()}
