#!/usr/bin/env python3
"""Files and gb_ symbols that comments and pages name must exist.

Usage: references.py SOURCE_DIR

A symbol exists where code or a string (environment variables) has it; `gb_name_*` and `gb_name_`
stand for all that begin so.  A file is named by its path or by the end of it; NAME in it is a
placeholder.  CHANGELOG.md names what was.
"""
import pathlib
import re
import sys

# Comments and strings of C, so that each can be told from the code.
PIECE = re.compile(r'/\*.*?\*/|//[^\n]*|"(?:\\.|[^"\\\n])*"', re.S)
FILE = re.compile(r'(?<![\w./<*-])((?:[\w-]+/)*[a-z]\w*\.(?:[ch]|py|sh|md))\b(?!\()')
SYMBOL = re.compile(r'\b((?:gb|GB)_\w+)(\*|\.\.\.)?')
FOLDERS = ('src', 'include', 'tests', 'docs', 'examples', 'assets')


def line_of(text, offset):
    return text.count('\n', 0, offset) + 1


def main():
    root = pathlib.Path(sys.argv[1])
    paths = [p for folder in FOLDERS for p in sorted((root / folder).rglob('*')) if p.is_file()]
    paths += [root / 'README.md', root / 'CONTRIBUTING.md', root / 'CHANGELOG.md']
    # every end of every path: a/b/c.h, b/c.h, c.h
    ends = {'/'.join(p.relative_to(root).parts[k:])
            for p in paths for k in range(len(p.relative_to(root).parts))}
    symbols, texts = set(), []
    for path in paths:
        if path.suffix in ('.c', '.h'):
            source = path.read_text(encoding='utf-8')
            for piece in PIECE.finditer(source):
                if piece.group()[0] == '/':
                    texts.append((path, line_of(source, piece.start()), piece.group()))
            code = PIECE.sub(lambda m: ' ' if m.group()[0] == '/' else m.group(), source)
            symbols.update(re.findall(r'\b(?:gb|GB)_\w+', code))
        elif path.suffix in ('.sh', '.build', '.py'):
            symbols.update(re.findall(r'\bGB_\w+', path.read_text(encoding='utf-8')))
        elif path.suffix == '.md' and path.name != 'CHANGELOG.md':
            texts.append((path, 1, path.read_text(encoding='utf-8')))
    found = []
    for path, line, text in texts:
        for match in FILE.finditer(text):
            if match.group(1) not in ends and 'NAME' not in match.group(1):
                found.append((path, line + line_of(text, match.start()) - 1, match.group(1)))
        for match in SYMBOL.finditer(text):
            name, family = match.group(1), match.group(2) or match.group(1).endswith('_')
            if name not in symbols and not (family and any(s.startswith(name) for s in symbols)):
                found.append((path, line + line_of(text, match.start()) - 1, name))
    for path, line, name in found:
        print(f'{path.relative_to(root)}:{line}: there is no {name}')
    print(f'references: {len(found)} to nothing')
    return bool(found)


if __name__ == '__main__':
    sys.exit(main())
