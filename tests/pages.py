#!/usr/bin/env python3
"""The tables of docs/manual.md name the commands and keys that the program has.

Usage: pages.py SOURCE_DIR GREENBODY

Every command has a line of the table of commands, and every line a command.  Every key of the
table of keys, which is a selection, is a key of the workbench.
"""
import pathlib
import re
import subprocess
import sys


def asked(greenbody, option):
    done = subprocess.run([greenbody, option], capture_output=True, text=True, check=True)
    return done.stdout.splitlines()


def rows(text, header):
    """First cells of the table that begins with this line."""
    lines = text.splitlines()
    for line in lines[lines.index(header) + 2:]:
        if not line.startswith('|'):
            return
        yield line.split('|')[1]


def main():
    text = (pathlib.Path(sys.argv[1]) / 'docs/manual.md').read_text(encoding='utf-8')
    commands = {line.split()[0] for line in asked(sys.argv[2], '--commands')}
    # the first ten columns are the names: "PgUp [", "^L"
    keys = {name for line in asked(sys.argv[2], '--keys') for name in line[:10].split()}
    named = {word for cell in rows(text, '| command | does |')
             for word in re.findall(r'`greenbody ([a-z]+)', cell)}
    pressed = {key for cell in rows(text, '| key | does |') for key in re.findall(r'`(.+?)`', cell)}
    wrong = [f'no line for greenbody {name}' for name in sorted(commands - named)]
    wrong += [f'there is no command {name}' for name in sorted(named - commands)]
    wrong += [f'there is no key {key}' for key in sorted(pressed - keys)]
    if not named or not pressed:
        wrong.append('a table is empty')
    for line in wrong:
        print(f'docs/manual.md: {line}')
    print(f'pages: {len(named)} commands, {len(pressed)} keys, {len(wrong)} errors')
    return bool(wrong)


if __name__ == '__main__':
    sys.exit(main())
