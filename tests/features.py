"""Checks the files of a build folder that its features are about with another compiler: they
include built_with.h, name a feature, or are no part of the main build.
Usage: features.py BUILD_FOLDER MAIN_BUILD_FOLDER COMPILER..."""
import json
import pathlib
import shlex
import subprocess
import sys

WITH_VALUE = ('-o', '-MF', '-MQ')


def commands(folder):
    """Compile commands by source file."""
    text = (folder / 'compile_commands.json').read_text(encoding='utf-8')
    return {(folder / entry['file']).resolve(): entry for entry in json.loads(text)}


def objects_about_features(folder):
    """Outputs whose headers, as ninja noted them, include the list of features."""
    text = subprocess.run(['ninja', '-C', folder, '-t', 'deps'], check=True, text=True,
                          capture_output=True).stdout
    found, output = set(), ''
    for line in text.splitlines():
        if line and not line[0].isspace():
            output = line.split(':')[0]
        elif line.endswith('base/built_with.h'):
            found.add(output)
    return found


def options(command):
    """Words of a compile command without the compiler and what it writes."""
    words = shlex.split(command)
    while not words[0].startswith('-'):
        words.pop(0)
    kept = [word for before, word in zip([''] + words, words)
            if before not in WITH_VALUE and word not in WITH_VALUE + ('-MD', '-c')]
    return kept


def is_good(entry, compiler):
    """The compiler has neither error nor warning."""
    command = compiler + ['-fsyntax-only', '-Werror'] + options(entry['command'])
    print(shlex.join(command), flush=True)
    return subprocess.run(command, cwd=entry['directory'], check=False).returncode == 0


def main():
    """Status 0: all are good, and there are some."""
    folder, other = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2])
    about = objects_about_features(folder)
    main_files = commands(other)
    chosen = [entry for file, entry in commands(folder).items()
              if entry['output'] in about or file not in main_files or
              'GB_WITH_' in file.read_text(encoding='utf-8')]
    results = [is_good(entry, sys.argv[3:]) for entry in chosen]
    print(f'{len(results)} files', flush=True)
    return 0 if results and all(results) else 1


sys.exit(main())
