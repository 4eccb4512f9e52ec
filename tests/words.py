#!/usr/bin/env python3
"""Refuses words that docs/glossary.md replaced by terms of the field, and phrases of messages that
have a better wording.

Usage: words.py SOURCE_DIR

Names: a part of an identifier between underscores, in C sources outside strings.
Texts: whole words in comments, strings and pages.  Names in files are a contract and stand in
strings; the few that hold an old word are listed in FILE_NAMES.
"""
import pathlib
import re
import sys

# Parts of identifiers.
NAMES = """
    stray strays sight hair crowd amend amended amends flock flocks drive drives driven narrow
    narrowed ahead spot spots ledger ledgers spare sift sifted deal dealt leap departure foretell
    foretold foresee asked crew boss letter letters ranks errand errands overheard swarm husk life
    pressing solo dress lens hush sheet album programme trial relief guess whoever somebody
    nobody manieth place places way ways arm arms turn turns turned
""".split()

# Words of comments, messages and pages.
TEXTS = """
    whoever whomever somebody someone nobody anybody manieth foretold foretell foretells stray
    strays flock flocks amend amends amended amendment amendments sift sifted errand errands
    overheard swarm husk crew ledger album albums programme programmes solo hush boss dealt
""".split()

# Messages and screen texts that have a better wording, in adjacent string literals.
PHRASES = re.compile(r"""
    goes[ ]on\b|\bgo[ ]on\b|being[ ]made|takes[ ]it[ ]away|misfit[ ]\S+[ ]points|time[ ]of[ ]work
    |(contacts|force)[ ]a[ ]particle|(sweeps|evaluations|steps)[ ]a[ ]second|100[ ]%[ ]in\b
    |the[ ]parameter[ ](up|down)\b|does[ ]not[ ]fit[ ]the[ ]rest|accepted[ ][-\d%]\S*[ ]to\b
    |accepted[ ]a[ ]value|is[ ]enough,|changes[ ]behind|nothing[ ]beats|error[ ]against[ ]cost
    |over[ ]a[ ]bridge|without[ ]bridge\b|pressure[ ]of[ ]the[ ]contacts|force[ ]over[ ]the[ ]mean[ ]of
    |lateral[ ]over|breaks[ ]a[ ]bridge|released[ ]at|share[ ]of[ ]the[ ](number|volume)\b(?![ ]that)
    |change[ ]of[ ]height|energy[ ]error|floor[ ]bears|least[ ]gap|way[ ]of[ ]the[ ]punch
    |keys[ ]fitted|where[ ]it[ ]comes[ ]from|\bwants[ ]--
    |between[ ]\S+[ ]and[ ]\S+[ ](growing[ ])?numbers
    """, re.X | re.I)
LITERALS = re.compile(r'"(?:\\.|[^"\\\n])*"(?:\s*"(?:\\.|[^"\\\n])*")*')

# What strings may hold all the same: items of checkpoints, whose names are a contract.
FILE_NAMES = re.compile(r'^(world|relax|bed|die|motion|load|programme|run)?/?'
                        r'(amended|place|places|turned|arm|turn)$')

# The same names where pages describe the contents of a checkpoint, and the command of
# util-linux.
ITEMS_IN_PAGES = re.compile(r'`world/amended`|^\.RI \( ?amended :|\bflock -n\b')

# Identifiers of other libraries, and of the system: flock(2) locks a file.
FOREIGN = re.compile(r'^(flock$|gsl_|GSL_|H5|g_|G_|cairo_|pango_|PANGO_|png_|GL_|gl[A-Z]|A_)')

TOKEN = re.compile(r'''(?P<comment>/\*.*?\*/|//[^\n]*)
                      |(?P<string>"(?:\\.|[^"\\\n])*")
                      |(?P<char>'(?:\\.|[^'\\\n])*')
                      |(?P<name>[A-Za-z_][A-Za-z0-9_]*)''', re.S | re.X)
WORD = re.compile(r'[A-Za-z]+')


def line_of(text, offset):
    return text.count('\n', 0, offset) + 1


def in_name(name):
    if FOREIGN.match(name):
        return None
    return next((part for part in name.lower().split('_') if part in NAMES), None)


def in_text(text):
    return next((w for w in WORD.findall(text) if w.lower() in TEXTS), None)


def check_c(path, text):
    for token in TOKEN.finditer(text):
        kind, value = token.lastgroup, token.group()
        if kind == 'name':
            word = in_name(value)
        elif kind == 'string' and FILE_NAMES.match(value[1:-1]):
            word = None
        elif kind in ('comment', 'string'):
            word = in_text(value)
        else:
            word = None
        if word:
            yield line_of(text, token.start()), word, value.split('\n')[0][:60]


def check_phrases(path, text):
    for literals in LITERALS.finditer(text):
        shown = re.sub(r'"\s*"', '', literals.group())
        phrase = PHRASES.search(shown)
        if phrase:
            yield line_of(text, literals.start()), phrase.group(), shown[:60]


def check_page(path, text):
    for number, line in enumerate(text.split('\n'), 1):
        word = in_text(ITEMS_IN_PAGES.sub('', line))
        if word:
            yield number, word, line.strip()[:60]


def files(root):
    for folder in ('src', 'include', 'tests', 'docs', 'presets'):
        for path in sorted((root / folder).rglob('*')):
            if 'corpus' not in path.parts and path.name != 'words.py':
                yield path
    for name in ('README.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'bootstrap', 'meson.build'):
        yield root / name


def main():
    root = pathlib.Path(sys.argv[1])
    found = 0
    for path in files(root):
        if path.suffix in ('.c', '.h'):
            check = check_c
        elif path.suffix in ('.md', '.sh', '.in', '.build', '.ini') or path.name == 'bootstrap':
            check = check_page
        else:
            continue
        if path.name == 'glossary.md' or not path.exists():
            continue
        text = path.read_text(encoding='utf-8')
        shown = check_phrases(path, text) if path.suffix == '.c' and path.is_relative_to(
            root / 'src') else ()
        for number, word, where in [*check(path, text), *shown]:
            found += 1
            print(f'{path.relative_to(root)}:{number}: "{word}" in: {where}')
    print(f'words: {found} old words')
    return found > 0


if __name__ == '__main__':
    sys.exit(main())
