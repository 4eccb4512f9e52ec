"""Builds without optional packages, out of tree and with warnings as errors.

Usage: features.py SOURCE MAIN_BUILD           each feature off alone, and all off
       features.py SOURCE MAIN_BUILD clang     reads every file of the main build with clang
       features.py SOURCE MAIN_BUILD clang-build    builds the program with clang, without
                                               any feature and with all of them

A feature compiles only the files that it touches: they include base/built_with.h, name a
feature, or do not belong to the main build.  All other objects come from the main build.
Prints TAP."""
import concurrent.futures
import functools
import json
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys
import tempfile

HANG_S = 1500
PROGRAM = 'src/cli/greenbody'
WITH_VALUE = ('-o', '-MF', '-MQ')
# Of one target: what ninja generates for it alone.
OWN_FOLDER = re.compile(r'-I\S+\.p')
FILES_AT_ONCE = 30


class Tap:
    """Counts and prints results."""

    def __init__(self):
        self.count, self.bad = 0, 0

    def result(self, name, log):
        """log: empty when good."""
        self.count += 1
        self.bad += bool(log)
        print(f"{'not ok' if log else 'ok'} {self.count} {name}", flush=True)
        wrong = [line for line in log.splitlines() if re.search('error|warning', line, re.I)]
        for line in (wrong or log.splitlines())[:10]:
            print('# ' + line[:200], flush=True)

    def end(self):
        """Prints the plan; the exit status."""
        print(f'1..{self.count}')
        return 1 if self.bad else 0


def run(command, folder='/', env=None):
    """Output when the command fails, else the empty text, and what it printed."""
    done = subprocess.run(command, cwd=folder, env=env, text=True, check=False, timeout=HANG_S,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    words = command if isinstance(command, str) else shlex.join(map(str, command))
    failed = f'error: status {done.returncode}: {words}\n{done.stdout}'
    return ('' if done.returncode == 0 else failed), done.stdout


def features_of(source):
    """Names of the options that are features."""
    text = (source / 'meson_options.txt').read_text(encoding='utf-8')
    return re.findall(r"option\('(\w+)', type : 'feature'", text)


def entries_of(folder):
    """Compile commands by output."""
    text = (folder / 'compile_commands.json').read_text(encoding='utf-8')
    return {entry['output']: entry for entry in json.loads(text)}


def outputs_with_list(folder):
    """Outputs whose headers, as ninja noted them, include the list of features."""
    done = subprocess.run(['ninja', '-C', folder, '-t', 'deps'], check=True, text=True,
                          capture_output=True, timeout=HANG_S)
    found, output = set(), ''
    for line in done.stdout.splitlines():
        if line and not line[0].isspace():
            output = line.split(':')[0]
        elif line.endswith('base/built_with.h'):
            found.add(output)
    return found


@functools.cache
def knows(compiler, flag):
    """Flags of code generation differ between compilers; nothing else is left out."""
    return not flag.startswith('-f') or not run(
        [compiler, '-fsyntax-only', '-Werror', flag, '-x', 'c', '/dev/null'])[0]


def words_for(compiler, entry):
    """The folder and the words for a compiler that only reads the file of a compile command."""
    words = shlex.split(entry['command'])
    while not words[0].startswith('-'):
        words.pop(0)
    kept = [word for before, word in zip([''] + words, words)
            if before not in WITH_VALUE and word not in WITH_VALUE + ('-MD', '-c') and
            not OWN_FOLDER.fullmatch(word) and knows(compiler, word)]
    kept.remove(entry['file'])
    # after the first file clang forgets the pragmas that GLib's headers turn warnings off with
    kept = [re.sub('^-I/', '-isystem/', word) for word in kept]
    return entry['directory'], (compiler, '-fsyntax-only', '-Werror', *kept)


def read_files(folder, words, files):
    """The complaint about files that have the same words.  One process of the compiler proper
    reads all of them: to start clang takes as long as to read a file."""
    failed, told = run([*words, '-###', files[0]], folder)
    if failed:
        return failed
    command = shlex.split(told.splitlines()[-1])
    place = command.index('-main-file-name')
    del command[place:place + 2]
    command.remove(files[0])
    return run(command + files, folder)[0]


def read_all(compiler, entries):
    """Complaints about all of them, with a process per processor."""
    alike = {}
    for entry in entries:
        alike.setdefault(words_for(compiler, entry), []).append(entry['file'])
    parts = [(*key, files[start:start + FILES_AT_ONCE]) for key, files in alike.items()
             for start in range(0, len(files), FILES_AT_ONCE)]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return ''.join(pool.map(lambda part: read_files(*part), parts))


def meson(source, folder, options, env=None):
    """Sets up a folder, or changes its options."""
    if (folder / 'build.ninja').exists():
        return run(['meson', 'setup', '--reconfigure', folder, source] + options)[0]
    return run(['meson', 'setup', folder, source, '-Dwerror=true', '-Dbuildtype=plain',
                '-Doptimization=0'] + options, env=env)[0]


def try_program(tap, name, folder, off):
    """The program says what it lacks, and computes a curve."""
    program = folder / PROGRAM
    failed, version = run([program, '--version'])
    if not failed and 'pictures' in off and 'no pictures' not in version:
        failed = 'error: --version does not say "no pictures"'
    with tempfile.TemporaryDirectory() as out:
        failed = failed or run([program, 'run', 'default', 'particles.count=50',
                                'loading.unload_from=', 'loading.until=1MPa', '--quiet',
                                '--force', '--out', out + '/run'])[0]
    tap.result(f'{name}: the program runs', failed)


class Features:
    """The builds of a source tree without some features."""

    def __init__(self, tap, source, main, folder):
        self.tap, self.source, self.main, self.folder = tap, source, main, folder
        self.main_entries = entries_of(main)
        self.with_list = outputs_with_list(main)
        self.has_clang = shutil.which('clang') is not None

    def touched(self, entries):
        """Compile commands of the files that features touch."""
        chosen = {}
        for output, entry in entries.items():
            text = (self.folder / entry['file']).read_text(encoding='utf-8')
            if (output not in self.main_entries or output in self.with_list or
                    not (self.main / output).exists() or 'GB_WITH_' in text):
                chosen[output] = entry
        return chosen

    def compile(self, touched):
        """Compiles these, takes the others from the main build, links."""
        done = subprocess.run(['ninja', '-C', self.folder, '-t', 'commands', PROGRAM],
                              check=True, text=True, capture_output=True, timeout=HANG_S)
        steps = [line for line in done.stdout.splitlines() if ' -c ' not in line]
        needed = set(re.findall(r'\S+\.o\b', '\n'.join(steps)))
        failed = run(['ninja', '-C', self.folder] + sorted(needed & set(touched)))[0]
        for output in needed - set(touched):
            (self.folder / output).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(self.main / output, self.folder / output)
        for step in steps:
            failed = failed or run(['sh', '-c', step], self.folder)[0]
        return failed

    def build(self, name, off, names):
        """Builds without the features `off`."""
        options = [f"-D{word}={'disabled' if word in off else 'auto'}" for word in names]
        failed = meson(self.source, self.folder, options)
        touched = {} if failed else self.touched(entries_of(self.folder))
        failed = failed or self.compile(touched)
        self.tap.result(f'{name}: {len(touched)} files compile', failed)
        if not failed:
            try_program(self.tap, name, self.folder, off)
        if self.has_clang:
            self.tap.result(f'{name}: and clang reads them', read_all('clang', touched.values()))


def build_with_clang(tap, source, folder, names):
    """The whole program, by clang."""
    env = {**os.environ, 'CC': 'clang'}
    for name, value, off in (('no feature', 'disabled', names), ('all features', 'auto', [])):
        failed = meson(source, folder, [f'-D{word}={value}' for word in names], env)
        failed = failed or run(['ninja', '-C', folder, PROGRAM])[0]
        tap.result(f'{name}, by clang', failed)
        if not failed:
            try_program(tap, f'{name}, by clang', folder, off)


def main():
    """Status 0: all builds are good."""
    source, main_build = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    tap, names = Tap(), features_of(source)
    kind = sys.argv[3] if len(sys.argv) > 3 else ''
    if kind == 'clang':
        entries = list(entries_of(main_build).values())
        tap.result(f'clang reads {len(entries)} files', read_all('clang', entries))
        return tap.end()
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch).resolve() / 'build'
        if kind == 'clang-build':
            build_with_clang(tap, source, folder, names)
            return tap.end()
        features = Features(tap, source, main_build, folder)
        features.build('all features off', names, names)
        for name in names:
            features.build(f'{name} off', [name], names)
    return tap.end()


sys.exit(main())
