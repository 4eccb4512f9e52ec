#!/usr/bin/env python3
"""Measures the sentences of the pages and refuses words that have a better one.

Usage: prose.py SOURCE_DIR

Sentences: prints, for each page, the median and the 90th percentile of words per sentence and the
numbers per 100 words.  Headings, tables, code blocks and fragments without a verb are no sentences.
References to papers, figures, equations and years are no numbers.

Words, in pages, help, messages and public headers: phrases with a plainer wording (PLAIN).
Words, also in comments and names of the code: terms that docs/glossary.md replaced (NAMES, TEXTS).
Names in files are a contract and appear in strings; FILE_NAMES lists the few that hold an old word.
"""
import bisect
import pathlib
import re
import sys

# Words per sentence at the median and at the 90th percentile; the aim is 15 and 28.
MEDIAN_LIMIT, P90_LIMIT = 18, 32

# Numbers per 100 words.
NUMBERS_LIMIT = 4
NUMBERS_LIMIT_OF = {'accuracy.md': 6, 'validation.md': 6}

# A paragraph of this many words is a sentence even if VERBS lacks its verb.
LONG_FRAGMENT = 12

# Still to be edited: their limits and their phrases of PLAIN are printed and do not fail.
UNEDITED_PAGES = ()
UNEDITED_FOLDERS = ()

# ---- sentences ----------------------------------------------------------------------------------

# Finite verbs of the pages.  Those that are nouns as well ("run", "measures") count at the
# beginning, before a word of OBJECTS and after a word of SUBJECTS.
VERBS = set("""
    accept accepts add adds agree agrees allow allows alternate alternates appear appears
    applies apply are aren't arise arises ask asks assume assumes average averages avoid avoids
    be become becomes been began begin begins belong belongs bring brings build builds call
    calls can cancel cancels cannot carries carry catch catches change changes check checks
    choose chooses come comes compare compares compute computed computes contain contains
    continue continues contribute contributes converge converges copies copy cost costs could
    count counts cover covers create creates damp damps decide decides declare declares define
    defines deform deforms depend depends describe describes detect detects determine determines
    did differ differs disturb divide divides do does doesn't don't draw draws drop drops edit
    edits end ends enter enters estimate estimates exceed exceeds exist exists exit exits expect
    expects explain explains export exports extend extends fail fails fall falls fill fills find
    finds finish finishes fit fits follow follows form forms found freeze freezes gain gains get
    gets give given gives go goes grow grows guarantee had has have hold holds ignore ignores
    implies imply include includes insert inserts install installs interpolate is isn't it's
    join joins keep keeps know knows lack lacks leave leaves left let lets lie lies limit limits
    link links list lists load loads lock locks log look looks loosens lose loses lost make
    makes mark marks match matches matter matters may mean means measures merge merges might
    miss misses model models move moves multiplies must name names need needs normalise
    normalises note notes occur occurs offer offers open opens overlap overlaps own owns pass
    passes places plot plots point pour pours prefer prefers press presses prevents print prints
    produce produces publish publishes pull pulls push pushes put puts read reads receive
    receives recompute recomputes record records recover recovers reduce reduces refer refers
    refuse refuses rejects relax relaxes remain remains remove removes rename renames repeat
    repeats replace replaces report reports reproduces require requires reset resets resist
    resists restore restores resume resumes return returns rise rises roll rolls run runs sample
    samples save saves say says scale scales scatter scatters script search see sees select
    selects send sends serve serves set sets shall share shares should show shows sink sinks
    skip skips slide slides solve solves sort sorts stand stands start starts state states stay
    stays step stick stop stops store stores suit suits sum sums support supports swap swaps
    switch sync syncs take takes tell tells test tests time times tolerates touch touches
    transform trust try turn turns type unload unloads update updates use used uses varies vary
    verifies verify vibrate vibrates view wait waits want wants warn warns was watch were will
    work works would write writes yield yields
    """.split())
NOUNS_TOO = set("""
    average averages build call calls change changes check checks computed contact contacts
    copies copy cost costs count counts cover cut draw end ends estimate estimates export
    exports fall falls fill fit fits force forces form forms found gain gains given hold left
    limit limits link links list lists load loads lock locks log lost mark marks match matches
    mean means measures model models move moves name names need note notes offer offers open
    pass place places plot plots point points press print pull push read reads record records
    report reports return returns rise roll rolls run runs sample samples scale scales scatter
    script search set sets share shares show sort sorts stand start starts state states step
    steps stop store stores sum sums support switch sync test tests time times touch trust try
    turn turns type update updates use used view wait watch work works yield yields
    """.split())
OBJECTS = set("""
    a after all an as code each every from how if it its no on one only other over the their
    them these this three to two until what when where whether which with your
    """.split())
SUBJECTS = set('it they you this these which that to code both all'.split())

ABBREVIATIONS = re.compile(
    r'\b(Figs?|Eqs?|Sec|No|vs|al|e\.g|i\.e|cf|Sh|Phys|Rev|Comput|Part|Mech|Trans|Metall|Soc|Powder'
    r'|Technol|Am|Ceram|Adv|Mater|approx|Vis|Graph|Radex|Rundsch|Vestn|Metalloprom|Chem|Lett'
    r'|J|Res|Faraday|Int|Appl|[A-Z])\.(?=\s)')
REFERENCES = re.compile(r'''
    \b(?:Figs?\.|Eqs?\.|[Ff]igures?|[Tt]ables?|[Ss]ec(?:tions?|\.)|[Pp]apers?|[Ee]quations?|P[1-3])
    [ ]*\(?(?:[0-9]+[a-z]?|[IVX]+)\)?(?:(?:,[ ]|[ ]and[ ]|[ ]to[ ]|-)\(?[0-9]+[a-z]?\)?)*
    |\([0-9]{1,2}\)            # an equation
    |\(?\b(?:19|20)[0-9]{2}\b\)?
    |\b[0-9]D\b
    |\b[A-Z][\w.]*\.[ ](?:[A-Z][\w.]*[ ])*[0-9]+,[ ][0-9]+    # Phys. Rev. E 88, 012209
    ''', re.X)
NUMBER = re.compile(r'(?<![\w.])[+±-]?[0-9][0-9.,]*(?:e-?[0-9]+)?')
CODE = 'CODE'


def blocks(text):
    """Paragraphs and list items as (is item, one line of plain text)."""
    text = re.sub(r'^(```|~~~).*?^\1[^\n]*$', '\n', text, flags=re.S | re.M)
    text = re.sub(r'<!--.*?-->', '', text, flags=re.S)
    block, item, found = [], False, []
    for line in text.split('\n') + ['']:
        bullet = re.match(r'\s*(?:[-*]|[0-9]+\.)\s+', line)
        skipped = re.match(r'\s*(?:\||#{1,6} |!\[[^\]]*\]\([^)]*\)\s*$|    {4})', line)
        if bullet or skipped or not line.strip():
            if block:
                found.append((item, ' '.join(block)))
            block, item = [], bool(bullet)
        if not skipped and line.strip():
            block.append((line[bullet.end():] if bullet else line).strip())
    for item, line in found:
        line = re.sub(r'!\[[^\]]*\]\([^)]*\)', '', line)
        line = re.sub(r'``.*?``|`[^`]*`', CODE, line)
        line = re.sub(r'\[([^\]]*)\]\([^)]*\)', r'\1', line)
        yield item, re.sub(r'[*_]{1,2}(?=\S)|(?<=\S)[*_]{1,2}', '', line).strip()


def words_of(sentence):
    return [word for word in sentence.split() if re.search(r'\w', word)]


def has_verb(words):
    plain = ['', *(re.sub(r"[^\w']", '', word).lower() for word in words), '']
    return plain[1] in VERBS or any(
        word in VERBS and (word not in NOUNS_TOO or after in OBJECTS or before in SUBJECTS)
        for before, word, after in zip(plain, plain[1:], plain[2:]))


def sentences(item, line):
    line = ABBREVIATIONS.sub(lambda m: m.group().replace('.', '\1'), line)
    for piece in re.split(r'(?<=[.?!])["\')\]]*\s+(?=["\'(\[]*[A-Z0-9])', line):
        words = words_of(piece.replace('\1', '.'))
        if words and (has_verb(words) or (not item and len(words) >= LONG_FRAGMENT)):
            yield words


def percentile(lengths, fraction):
    """Linear between the sorted values."""
    ranked = sorted(lengths) or [0]
    at = fraction * (len(ranked) - 1)
    low = int(at)
    high = min(low + 1, len(ranked) - 1)
    return ranked[low] + (at - low) * (ranked[high] - ranked[low])


def measure(text):
    """Sentences, median, 90th percentile, numbers per 100 words."""
    lengths, words, numbers = [], 0, 0
    for item, line in blocks(text):
        lengths += [len(sentence) for sentence in sentences(item, line)]
        plain = REFERENCES.sub(' ', line)
        words += len(words_of(line))
        numbers += len(NUMBER.findall(plain))
    return (len(lengths), percentile(lengths, 0.5), percentile(lengths, 0.9),
            100 * numbers / max(words, 1))


def check_sentences(root):
    """Prints the table; the number of pages above a limit."""
    pages = [root / 'README.md', root / 'CONTRIBUTING.md', *sorted((root / 'docs').glob('*.md'))]
    above = 0
    print(f'{"page":24}{"sentences":>10}{"median":>8}{"90 %":>8}{"numbers":>9}')
    for page in pages:
        count, median, p90, numbers = measure(page.read_text(encoding='utf-8'))
        bad = [name for name, wrong in (
            ('sentences, none found', count < 3),
            ('median', median > MEDIAN_LIMIT), ('90 %', p90 > P90_LIMIT),
            ('numbers', numbers > NUMBERS_LIMIT_OF.get(page.name, NUMBERS_LIMIT))) if wrong]
        above += bool(bad) and page.name not in UNEDITED_PAGES
        print(f'{page.name:24}{count:10}{median:8.1f}{p90:8.1f}{numbers:9.1f}'
              + ('   above the limit: ' + ', '.join(bad) if bad else ''))
    return above


# ---- words --------------------------------------------------------------------------------------

# Phrases with a plainer wording, each with what to write instead.
PLAIN = [(re.compile(pattern, re.I), plain) for pattern, plain in (
    (r'\bbehind\b', 'after'),
    (r'\bbeside\b', 'next to, as well as'),
    (r'\b(?:those|that) of\b', 'the noun again'),
    (r'\btold\b', 'prints, reports, shows'),
    (r'\bsays\b', 'prints, reports, shows'),
    (r'(?<!\bis )(?<!\bare )(?<!\bbe )(?<!\bwas )\baccepted\b', 'expected'),
    (r'\b(?:is|are|was|were) due\b(?! to\b)', 'must be called'),
    (r'\b(?:is|are|was|were) had\b', 'exists'),
    (r'\banew\b', 'is rebuilt, begins again'),
    (r'\b(?:same|other) bits\b|\b(?:has|have|gives?) the bits\b', 'bit-identical results'),
    (r'\bby hand\b|\blooked at\b|\bin turn\b|\bquick(?:er|est)? hour\b', 'leave it out'),
    (r'\bwhat is not there\b|\bas far as\b|\bbe it\b|\bnone such\b', 'say it directly'),
    (r'\bstands in\b(?! for\b)|\bgo(?:es)? by\b|\bcomes? out at\b|\b(?:is|are) of\b', 'is in, uses, is'),
    (r'\b(?:a|the) share of\b|\ba part of\b', 'fraction'),
)]

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
    |\b(is|are)[ ]accepted\b|accepted[ ]a[ ]value|is[ ]enough,|changes[ ]behind|nothing[ ]beats|error[ ]against[ ]cost
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
COMMENT = re.compile(r'/\*.*?\*/|//[^\n]*', re.S)
PYTHON_TEXT = re.compile(r'""".*?"""|#[^\n]*', re.S)
WORD = re.compile(r'[A-Za-z]+')


def line_of(text, offset):
    return text.count('\n', 0, offset) + 1


def in_name(name):
    if FOREIGN.match(name):
        return None
    return next((part for part in name.lower().split('_') if part in NAMES), None)


def in_text(text):
    return next((w for w in WORD.findall(text) if w.lower() in TEXTS), None)


def check_c(text):
    """Old terms of the code."""
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
            yield line_of(text, token.start()), word, value.split('\n')[0]


def check_page(text):
    """Old terms on a page."""
    for number, line in enumerate(text.split('\n'), 1):
        word = in_text(ITEMS_IN_PAGES.sub('', line))
        if word:
            yield number, word, line.strip()


def plain_words(text, first_line):
    """Phrases of PLAIN, which may continue on the next line."""
    found = [m for m in re.finditer(r'\S+', text) if m.group() not in ('*', '/*', '*/')]
    starts, flat = [], ''
    for word in found:
        starts.append(len(flat))
        flat += word.group() + ' '
    for pattern, plain in PLAIN:
        for match in pattern.finditer(flat):
            at = match.start()
            word = found[bisect.bisect_right(starts, at) - 1]
            yield (first_line + text.count('\n', 0, word.start()), match.group(),
                   f'{flat[max(at - 25, 0):at + 35].strip()}  ({plain})')


def literals_of(text):
    """Adjacent string literals as one text, with the line of the first."""
    code = COMMENT.sub(lambda m: re.sub(r'[^\n]', ' ', m.group()), text)
    for literals in LITERALS.finditer(code):
        yield line_of(text, literals.start()), re.sub(r'"\s*"', '', literals.group())


def check_messages(text):
    """PHRASES in messages, help and screen texts."""
    for number, shown in literals_of(text):
        phrase = PHRASES.search(shown)
        if phrase:
            yield number, phrase.group(), shown


def check_literals(text):
    """Phrases of PLAIN in messages, help and screen texts."""
    for number, shown in literals_of(text):
        yield from plain_words(re.sub(r'\\n', '  ', shown), number)


def check_header(text):
    """Phrases in the comments of a public header."""
    for comment in COMMENT.finditer(text):
        yield from plain_words(comment.group(), line_of(text, comment.start()))


def check_python(text):
    """Phrases in docstrings and comments."""
    for piece in PYTHON_TEXT.finditer(text):
        yield from plain_words(piece.group(), line_of(text, piece.start()))


def check_prose(text):
    """Phrases on a page, outside code."""
    hidden = re.sub(r'^(```|~~~).*?^\1|``.*?``|`[^`]*`',
                    lambda m: re.sub(r'[^\n]', '.', m.group()), text, flags=re.S | re.M)
    yield from plain_words(hidden, 1)


def files(root):
    for folder in ('src', 'include', 'tests', 'docs', 'presets', 'examples', 'assets', 'python'):
        for path in sorted((root / folder).rglob('*')):
            if 'corpus' not in path.parts and path.name != 'prose.py':
                yield path
    for name in ('README.md', 'CONTRIBUTING.md', 'CHANGELOG.md', 'bootstrap', 'meson.build'):
        yield root / name


def checks(root, path):
    """The checks of words that a file is subject to."""
    shown = not path.is_relative_to(root / 'tests')
    if path.suffix in ('.c', '.h'):
        yield check_c
        if shown and path.suffix == '.c':
            yield check_messages
            yield check_literals
        if path.is_relative_to(root / 'include'):
            yield check_header
    elif path.suffix in ('.md', '.sh', '.in', '.build', '.ini', '.py') or path.name == 'bootstrap':
        if path.name != 'glossary.md' and path.suffix != '.py':
            yield check_page
        if shown and path.suffix in ('.md', '.ini', '.in'):
            yield check_prose
        if shown and path.suffix == '.py':
            yield check_python
    if path.name == 'bootstrap':
        yield check_literals


def check_words(root):
    """Prints each word; their number."""
    found = 0
    for path in files(root):
        if not path.is_file():
            continue
        text = None
        for check in checks(root, path):
            text = text or path.read_text(encoding='utf-8')
            plain = check in (check_literals, check_header, check_prose, check_python)
            waits = plain and (path.name in UNEDITED_PAGES or
                               path.relative_to(root).parts[0] in UNEDITED_FOLDERS)
            for number, word, where in check(text):
                found += not waits
                print(f'{path.relative_to(root)}:{number}: "{word}" in: {where[:100]}')
    return found


def main():
    root = pathlib.Path(sys.argv[1])
    words = check_words(root)
    pages = check_sentences(root)
    print(f'prose: {words} words to replace, {pages} pages above a limit')
    return words > 0 or pages > 0


if __name__ == '__main__':
    sys.exit(main())
