#!/usr/bin/env python3
# SPDX-FileCopyrightText: 2026 The porttool authors
# SPDX-License-Identifier: Apache-2.0
"""Man pages and completion have every command and option that a program's help has: manuals_test.py PROGRAM..."""
import gzip
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

MANUALS = pathlib.Path(__file__).parent.parent / "packaging" / "manuals.py"


def help_of(*words):
    return subprocess.run([*words, "--help"], check=True, capture_output=True, text=True).stdout


def require(condition, what):
    if not condition:
        sys.exit("manuals_test: " + what)


def options_in(text):
    return {name for line in re.findall(r"^  (-\S+)", text, re.MULTILINE) for name in line.split(",")}


def completes(file, program, words):
    """What bash offers for the last of the words."""
    script = f". {file}; COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; _{program}; printf '%s\\n' \"${{COMPREPLY[@]}}\""
    return subprocess.run(["bash", "-c", script], check=True, capture_output=True, text=True).stdout.split()


def try_program(program, folder):
    name = pathlib.Path(program).name
    subprocess.run([sys.executable, MANUALS, program, folder], check=True)
    top = help_of(program)
    commands = re.findall(r"^  ([a-z]+) ", top.split("Subcommands:")[1], re.MULTILINE)
    require(len(commands) > 3, "no commands in the help of " + name)
    files = [folder / f"bash-completion/completions/{name}", folder / f"zsh/vendor-completions/_{name}",
             folder / f"fish/vendor_completions.d/{name}.fish"]
    bash, zsh, fish = (file.read_text() for file in files)
    for command in ["", *commands]:
        text = help_of(program, *command.split())
        page = gzip.decompress((folder / f"man/man1/{'-'.join([name, *command.split()])}.1.gz").read_bytes()).decode()
        offered = completes(files[0], name, [name, command, "-"]) if command else []
        for option in options_in(text):
            require(option.replace("-", "\\-") in page, f"{option} is not in the page of {name} {command}")
            if command:
                require(option in offered, f"bash: {name} {command} {option}")
                require(re.search(rf"^        {command}\).*'{option}\[", zsh, re.MULTILINE), f"zsh: {name} {command} {option}")
            if command and option not in options_in(top):
                flag = f"-l {option[2:]}" if option.startswith("--") else f"-s {option[1:]}"
                require(re.search(rf"__fish_seen_subcommand_from {command}'.*{flag}\b", fish), f"fish: {name} {command} {option}")
        if shutil.which("groff"):
            printed = subprocess.run(["groff", "-man", "-ww", "-Tascii"], input=page, capture_output=True, text=True)
            require(printed.returncode == 0 and not printed.stderr, f"groff on {name} {command}: {printed.stderr}")
    require(set(completes(files[0], name, [name, '""'])) >= set(commands), "bash does not offer the commands of " + name)
    for shell, file in (("zsh", files[1]), ("fish", files[2])):
        if shutil.which(shell):
            subprocess.run([shell, "-n", file], check=True)


with tempfile.TemporaryDirectory() as folder:
    for program in sys.argv[1:]:
        try_program(program, pathlib.Path(folder))
print(f"{len(sys.argv) - 1} programs: all commands and options in man pages and completion")
