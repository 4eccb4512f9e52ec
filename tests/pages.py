#!/usr/bin/env python3
"""docs/manual.md names the commands and keys that the program has.

Usage: pages.py SOURCE_DIR GREENBODY

The table of commands has every command and no other, and the table of exit statuses every status.
The manual describes a selection of the keys: each code span of one character, outside the table of
the ten tasks, is a key of the workbench.  Figures, commands, presets and tests that the pages name
exist, and docs/papers.md has every figure whose source is one of the papers.
Every picture of assets is shown by a page and has a row of assets/README.md.  Links lead to files and
headings that exist.
"""
import pathlib
import re
import subprocess
import sys

HANG_S = 300


def asked(greenbody, option):
    done = subprocess.run([greenbody, option], capture_output=True, text=True, check=True,
                          timeout=HANG_S)
    return done.stdout.splitlines()


def rows(text, header, column=0):
    """Cells of a column of the table that begins with this line."""
    lines = text.splitlines()
    for line in lines[lines.index(header) + 2:]:
        if not line.startswith('|'):
            return
        yield line.split('|')[1 + column]


PICTURES = '| picture | runs, then the command with `-o` and its file |'

# "  rdf   radial distribution function (P1 Fig. 4, 7)"
FIGURE = re.compile(r'^  ([a-z-]+) +\S.*?(?: \((P[123] [^)]*)\))?$')


def figures(greenbody):
    """Names of the figures, each with its source in the papers, or ''."""
    done = subprocess.run([greenbody, 'plot', '--help'], capture_output=True, text=True, check=True,
                          timeout=HANG_S)
    lines = done.stdout.splitlines()
    found = {}
    for line in lines[lines.index('Figures:') + 1:]:
        match = FIGURE.match(line)
        if match is None:
            return found
        found[match.group(1)] = match.group(2) or ''
    return found


# "(`store`, `run`)" and the last cells of tables of docs/threats.md, which name only tests; elsewhere
# "test `name`".
NAMES = r'`\w\w+`(?:, `\w\w+`)*'
CLAIMS = re.compile(rf'\(({NAMES})\)|\| ({NAMES}) \|$', re.MULTILINE)
TEST = re.compile(r'\btests? `(\w+)`')


def tests(source):
    """Names in the build files of the tests; some are put together of two words there."""
    words = {word for path in source.glob('tests/**/meson.build')
             for word in re.findall(r"'(\w+)'", path.read_text(encoding='utf-8'))}
    return words | {first + second for first in words if first.endswith('_') for second in words} | \
        {first + second for second in words if second.startswith('_') for first in words}


def wrong_tests(source):
    """One line for each test on the pages that there is not."""
    known = tests(source)
    for page in [*sorted(source.glob('docs/*.md')), source / 'CONTRIBUTING.md']:
        text = page.read_text(encoding='utf-8')
        named = set(TEST.findall(text))
        if page.name == 'threats.md':
            cells = [cell for match in CLAIMS.findall(text) for cell in match]
            named |= set(re.findall(r'\w+', ' '.join(cells)))
            if len(named) < 20:
                yield f'{page.relative_to(source)}: names of tests are not found'
        for name in sorted(named - known):
            yield f'{page.relative_to(source)}: there is no test {name}'


def wrong_pages(source, known, commands):
    """One line for each name on the pages that does not exist."""
    presets = {path.stem for path in (source / 'presets').glob('*.ini')}
    for page in sorted(source.glob('docs/*.md')):
        text = page.read_text(encoding='utf-8')
        for name in re.findall(r'--figure ([a-z-]+)', text):
            if name not in known:
                yield f'{page.name}: there is no figure {name}'
        for name in re.findall(r'^\|[^|]*\| `greenbody ([a-z]+)', text, re.MULTILINE):
            if name not in commands:
                yield f'{page.name}: there is no command {name}'
        for name in re.findall(r'greenbody (?:run|pack|sweep) (p[123]-[\w.-]+)', text):
            if name not in presets and not name.startswith('p3-$'):
                yield f'{page.name}: there is no preset {name}'
    drawn = set(re.findall(r'--figure ([a-z-]+)',
                           (source / 'docs/papers.md').read_text(encoding='utf-8')))
    for name, paper in known.items():
        if paper and not paper.startswith('P2 sec.') and name not in drawn:
            yield f'papers.md: no line for the figure {name}, {paper}'


def wrong_pictures(source):
    """One line for each picture of assets that no page shows, or that nothing says how to make."""
    shown = set()
    for page in [source / 'README.md', *sorted(source.glob('docs/*.md'))]:
        shown |= set(re.findall(r'\]\((?:\.\./)?assets/([\w.-]+\.png)\)',
                                page.read_text(encoding='utf-8')))
    recipe = (source / 'assets/README.md').read_text(encoding='utf-8')
    made = {name for cell in rows(recipe, PICTURES) for name in re.findall(r'`(.+?)`', cell)}
    there = {path.name for path in (source / 'assets').glob('*.png')}
    for name in sorted(there | shown | made):
        for names, wrong in ((there, 'assets has no'), (shown, 'no page shows'),
                             (made, 'assets/README.md does not say how to make')):
            if name not in names:
                yield f'{wrong} {name}'
    for path in sorted((source / 'assets').glob('*.png')):
        if path.stat().st_size > 600000:
            yield f'{path.name}: more than 600 kB'


def anchors(text):
    """Of the headings, as GitHub makes them."""
    text = re.sub(r'^```.*?^```', '', text, flags=re.DOTALL | re.MULTILINE)
    return {re.sub(r'[^\w -]', '', heading.lower()).strip().replace(' ', '-')
            for heading in re.findall(r'^#+ +(.*)$', text, re.MULTILINE)}


def wrong_links(source):
    """One line for each link to a file or heading that does not exist."""
    for page in [*sorted(source.glob('*.md')), *sorted(source.glob('docs/*.md')),
                 source / 'assets/README.md']:
        for file, heading in re.findall(r'\]\((?!https?:)([^)#]*)(?:#([^)]*))?\)',
                                        page.read_text(encoding='utf-8')):
            target = page.parent / file if file else page
            if not target.exists():
                yield f'{page.relative_to(source)}: there is no {file}'
            elif heading and heading not in anchors(target.read_text(encoding='utf-8')):
                yield f'{page.relative_to(source)}: {target.name} has no heading #{heading}'


def main():
    text = (pathlib.Path(sys.argv[1]) / 'docs/manual.md').read_text(encoding='utf-8')
    commands = {line.split()[0] for line in asked(sys.argv[2], '--commands')}
    # the first ten columns are the names: "PgUp [", "^L"
    keys = {name for line in asked(sys.argv[2], '--keys') for name in line[:10].split()}
    named = {word for cell in rows(text, '| to do | command | page |', 1)
             for word in re.findall(r'`greenbody ([a-z]+)', cell)}
    tasks = re.compile(r'^\| [0-9]+ \| .*', re.MULTILINE)
    pressed = set(re.findall(r'(?<!`)`([^`\s])`(?!`)', tasks.sub('', text)))
    wrong = [f'no line for greenbody {name}' for name in sorted(commands - named)]
    wrong += [f'there is no command {name}' for name in sorted(named - commands)]
    wrong += [f'there is no key {key}' for key in sorted(pressed - keys)]
    statuses = {line.split()[0] for line in asked(sys.argv[2], '--exit-statuses')}
    described = {cell.strip() for cell in rows(text, '| exit status | meaning |')}
    wrong += [f'exit status {status} is in one table only'
              for status in sorted(statuses ^ described)]
    if not named or len(pressed) < 20:
        wrong.append('commands or keys are not found')
    wrong = [f'docs/manual.md: {line}' for line in wrong]
    known = figures(sys.argv[2])
    wrong += [f'docs/{line}' for line in wrong_pages(pathlib.Path(sys.argv[1]), known, commands)]
    wrong += wrong_tests(pathlib.Path(sys.argv[1]))
    wrong += wrong_pictures(pathlib.Path(sys.argv[1]))
    wrong += wrong_links(pathlib.Path(sys.argv[1]))
    if not known:
        wrong.append('plot --help: no list of figures')
    for line in wrong:
        print(line)
    print(f'pages: {len(named)} commands, {len(pressed)} keys, {len(known)} figures, '
          f'{len(wrong)} errors')
    return bool(wrong)


if __name__ == '__main__':
    sys.exit(main())
