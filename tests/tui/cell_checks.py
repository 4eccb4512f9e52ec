"""What must hold for the cells of a screen; rows as cell_terminal.py captures them."""
import re

BELOW_ROWS = 3  # message and footer
VERTICAL = set('│├┤┼┬┴┌┐└┘|+')
AXIS = set('│┤┼├└┬')
NUMBER = re.compile(r'[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?')


def cells(row, cols):
    return row.ljust(cols)


def box_of(rows, title):
    """Corners of the box with this title: row, left, right, last row; None: no box."""
    for top, row in enumerate(rows):
        match = re.search(r'[┌+][─-]+ ' + re.escape(title) + r'[^┐+]* [─-]*[┐+]', row)
        if match and top + 1 < len(rows):
            left, right = match.start(), match.end() - 1
            last = top + 1
            while last < len(rows) and cells(rows[last], right + 1)[left] in '│|':
                last += 1
            if last > top + 1 and last < len(rows):
                return top, left, right, last
    return None


def check_box(rows, title, faults):
    """The box is closed; returns it."""
    box = box_of(rows, title)
    if box is None:
        faults.append('no box')
        return None
    top, left, right, last = box
    for at in range(top + 1, last):
        if cells(rows[at], right + 1)[right] not in '│|':
            faults.append(f'right border of the box in row {at + 1}')
    bottom = cells(rows[last], right + 1)[left:right + 1]
    if not re.fullmatch(r'[└+][─-]+[┘+]', bottom):
        faults.append('bottom of the box')
    return box


def borders_of(rows):
    """Columns of the vertical borders, each with the row that it begins in."""
    joins = re.finditer(r'[─-]([┬+])[─-]', rows[1] if len(rows) > 1 else '')
    return [match.start(1) for match in joins]


def check_panes(rows, cols, faults):
    """Borders between panes are whole down to the row before the message."""
    columns = borders_of(rows)
    for col in columns:
        above = rows[:-BELOW_ROWS]
        last = max((at for at, row in enumerate(above) if cells(row, cols)[col] in VERTICAL),
                   default=0)
        for at in range(1, last + 1):
            if cells(rows[at], cols)[col] not in VERTICAL:
                faults.append(f'border of column {col + 1} in row {at + 1}')
    return columns


def check_axis(rows, cols, faults):
    """The ticks of an axis stand in one column, with nothing else between them and the
    corner where the other axis begins."""
    ticks = {}
    for at, row in enumerate(rows):
        for match in re.finditer(r'\d(┤)', row):
            ticks.setdefault(match.start(1), []).append(at)
    for col, found in ticks.items():
        column = [cells(row, cols)[col] for row in rows]
        while found:
            first = found[0]
            corner = column.index('└', first) if '└' in column[first:] else None
            axis = [at for at in found if corner is None or at < corner]
            found = found[len(axis):]  # of the axis of another pane below
            if len(axis) < 2:  # a single number before a border
                continue
            if corner is None:
                faults.append(f'axis of column {col + 1} without its corner')
            for at in range(first, corner or axis[-1]):
                if column[at] not in AXIS:
                    faults.append(f'axis of column {col + 1} in row {at + 1}: {column[at]!r}')


def numbers(rows):
    return {token for row in rows for token in NUMBER.findall(row)}


def check_numbers(rows, cols, edges, whole, faults, cut):
    """No number at an edge is the beginning of one of the wide screen; none before an
    ellipsis behind a word."""
    for at, row in enumerate(rows[:-1]):
        if cut and cut.search(row):
            faults.append(f'cut number in row {at + 1}: {row.strip()}')
        for edge in edges:
            if edge < cols and cells(row, cols)[edge] not in VERTICAL:
                continue  # a message below the panes goes on there
            left = cells(row, cols)[:edge].rstrip(' ')
            if len(left) < edge - 1:
                continue
            match = re.search(NUMBER.pattern + r'$', left)
            if match and match[0] not in whole and any(
                    token != match[0] and token.startswith(match[0]) for token in whole):
                faults.append(f'number at the edge in row {at + 1}: {match[0]}')


def check_mode(terminal, mode, name, faults):
    if mode == 'ascii' and any(ord(c) > 126 for row in terminal.rows for c in row):
        faults.append('not ASCII')
    sent = '\n'.join(terminal.tmux('capture-pane', '-p', '-e', '-t', 'work'))
    colours = set(re.findall(r'\x1b\[[0-9;]*(?:[34][0-7]|[34]8;5;\d+|9[0-7]|10[0-7])m', sent))
    if mode == 'mono' and colours:
        faults.append(f'colours: {colours}')
    # the shades of a packing are backgrounds
    if mode == 'light' and 'view 9' not in name and any('48;5;' in c for c in colours):
        faults.append('a background of its own')
