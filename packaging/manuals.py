#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Man pages and shell completion of a program, from its command table, which it prints itself:

    packaging/manuals.py PROGRAM FOLDER

Asks PROGRAM for `--help`, and for that of each subcommand, and writes into FOLDER, as they are installed below /usr/share:
man/man1/PROGRAM.1.gz and PROGRAM-COMMAND.1.gz, bash-completion/completions/PROGRAM, zsh/vendor-completions/_PROGRAM and
fish/vendor_completions.d/PROGRAM.fish. The same program gives the same bytes.
"""
import gzip
import pathlib
import re
import subprocess
import sys


class Option:
    def __init__(self, left, help_text):
        words = re.sub(r" Excludes:.*| REQUIRED", "", left).split()
        self.names = words[0].split(",")
        self.value = " ".join(words[1:]).removesuffix(" ...")
        known = re.search(r"\{(.*)\}", self.value)
        self.choices = known.group(1).split(",") if known else []
        if known:
            self.value = "|".join(self.choices)
        self.help = help_text

    def takes_file(self):
        return any(word in self.value for word in ("FILE", "DIR"))


class Help:
    """What `--help` says: one line of what it does, the usage, arguments, options, subcommands."""

    def __init__(self, text):
        lines = text.splitlines()
        self.summary = lines[0]
        self.usage = next(line.removeprefix("Usage: ") for line in lines if line.startswith("Usage: "))
        column = next(re.match(r"  -h,--help\s+", line).end() for line in lines if line.startswith("  -h,--help"))
        self.sections, section = {}, None
        for line in lines:
            if re.fullmatch(r"[A-Z][a-z]+:", line):
                section = self.sections.setdefault(line[:-1], [])
            elif line.startswith(" " * column) and section:
                section[-1][1] = (section[-1][1] + " " + line.strip()).strip()
            elif line.startswith("  ") and section is not None:
                whole = len(line) > column and line[column - 1] == " "
                section.append([line[:column].strip() if whole else line.strip(), line[column:].strip() if whole else ""])
        self.options = [Option(*entry) for entry in self.sections.get("Options", [])]
        self.arguments = self.sections.get("Positionals", [])
        self.commands = self.sections.get("Subcommands", [])


def ask(program, *words):
    return Help(subprocess.run([program, *words, "--help"], check=True, capture_output=True, text=True).stdout)


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text.startswith((".", "'")) else text


def man_page(name, version, page, others):
    out = [f'.TH "{name.upper()}" 1 "" "{version}" "User Commands"', ".SH NAME", f"{roff(name)} \\- {roff(page.summary)}",
           ".SH SYNOPSIS", f".B {roff(page.usage)}"]
    for title, entries in (("ARGUMENTS", page.arguments), ("COMMANDS", page.commands),
                           ("OPTIONS", [[", ".join(o.names) + (" " + o.value if o.value else ""), o.help] for o in page.options])):
        if entries:
            out.append(f".SH {title}")
        for left, right in entries:
            out += [".TP", f".B {roff(left.replace(' REQUIRED', ''))}", roff(right)]
    out += [".SH EXIT STATUS", ".TP", ".B 0", "done; for a gate: nothing to act on", ".TP", ".B 1",
            "done, and the answer is no", ".TP", ".B 2", "could not be done; one or two lines on stderr say why",
            ".TP", ".B 130, 143", "interrupted; what was there is written whole"]
    if others:
        out += [".SH SEE ALSO", ", ".join(f".BR {roff(other)} (1)" for other in others).replace(", .BR", ",\n.BR")]
    return "\n".join(out) + "\n"


def bash(program, main, commands):
    def words(*groups):
        return " ".join(dict.fromkeys(name for options in groups for option in options for name in option.names))

    cases = []
    for name, page in commands.items():
        cases.append(f'        {name}) words="{words(page.options, main.options)}" ;;')
    values = {}
    for page in (main, *commands.values()):
        for option in page.options:
            if option.choices:
                values.setdefault("|".join(option.names), option.choices)
    choices = [f'        {names}) COMPREPLY=($(compgen -W "{" ".join(known)}" -- "$word")); return ;;'
               for names, known in values.items()]
    return f"""# bash completion of {program}, made by packaging/manuals.py
_{program}() {{
    local word=${{COMP_WORDS[COMP_CWORD]}} previous=${{COMP_WORDS[COMP_CWORD - 1]}} command= words= i
    for ((i = 1; i < COMP_CWORD; ++i)); do
        case ${{COMP_WORDS[i]}} in {"|".join(commands)}) command=${{COMP_WORDS[i]}}; break ;; esac
    done
    case $previous in
{chr(10).join(choices)}
    esac
    case $command in
{chr(10).join(cases)}
        *) words="{" ".join(commands)} {words(main.options)}" ;;
    esac
    if [[ $word == -* || -z $command ]]; then COMPREPLY=($(compgen -W "$words" -- "$word")); fi
    if [[ $word != -* && -n $command ]]; then compopt -o default; COMPREPLY=(); fi
}}
complete -F _{program} {program}
"""


def zsh(program, main, commands):
    def quoted(text):
        return text.replace("\\", "\\\\").replace("'", "'\\''").replace("[", "\\[").replace("]", "\\]").replace(":", "\\:")

    def arguments(options):
        for option in options:
            action = ""
            if option.value:
                kind = f"({' '.join(option.choices)})" if option.choices else "_files" if option.takes_file() else ""
                action = f":{quoted(option.value)}:{kind}"
            for name in option.names:
                yield f"'{name}[{quoted(option.help)}]{action}'"

    described = " ".join(f"'{name}:{quoted(page.summary)}'" for name, page in commands.items())
    cases = "\n".join(f"        {name}) _arguments {' '.join(arguments({tuple(o.names): o for o in [*main.options, *page.options]}.values()))} '*:file:_files' ;;"
                      for name, page in commands.items())
    return f"""#compdef {program}
# zsh completion of {program}, made by packaging/manuals.py
_{program}() {{
    local -a commands
    commands=({described})
    local command=${{words[(r)({"|".join(commands)})]}}
    case $command in
{cases}
        *) _arguments {' '.join(arguments(main.options))} && return; _describe command commands ;;
    esac
}}
_{program} "$@"
"""


def fish(program, main, commands):
    def quoted(text):
        return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"

    def complete(condition, option):
        words = [f"complete -c {program}" + (f" -n {quoted(condition)}" if condition else "")]
        for name in option.names:
            words.append(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}")
        if option.choices:
            words.append(f"-x -a {quoted(' '.join(option.choices))}")
        elif option.value:
            words.append("-r" if option.takes_file() else "-x")
        return " ".join(words) + f" -d {quoted(option.help)}"

    lines = [f"# fish completion of {program}, made by packaging/manuals.py"]
    lines += [complete("", option) for option in main.options]
    for name, page in commands.items():
        lines.append(f"complete -c {program} -n __fish_use_subcommand -f -a {name} -d {quoted(page.summary)}")
        lines += [complete(f"__fish_seen_subcommand_from {name}", o) for o in page.options if "-h" not in o.names]
    return "\n".join(lines) + "\n"


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    name = pathlib.Path(program).name
    version = subprocess.run([program, "--version"], check=True, capture_output=True, text=True).stdout.strip()
    top = ask(program)
    commands = {command: ask(program, command) for command, _ in top.commands}
    pages = {name: man_page(name, version, top, [f"{name}-{command}" for command in commands])}
    for command, page in commands.items():
        pages[f"{name}-{command}"] = man_page(f"{name}-{command}", version, page, [name])
    for page, text in pages.items():
        file = folder / "man/man1" / f"{page}.1.gz"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_bytes(gzip.compress(text.encode(), mtime=0))
    for file, text in ((f"bash-completion/completions/{name}", bash(name, top, commands)),
                       (f"zsh/vendor-completions/_{name}", zsh(name, top, commands)),
                       (f"fish/vendor_completions.d/{name}.fish", fish(name, top, commands))):
        (folder / file).parent.mkdir(parents=True, exist_ok=True)
        (folder / file).write_text(text)


main()
