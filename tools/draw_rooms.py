#!/usr/bin/env python3
"""Draws the rooms of cmake/layers.txt as an SVG: python3 tools/draw_rooms.py [--check]
[docs/images/rooms.svg].

A room stands below all rooms that it may include. A line joins it to those that no other line leads
to. The colours are the groups of the table. With --check nothing is written: the exit code says
whether the file is what would be written.
"""
import argparse
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
BOX_WIDTH, BOX_HEIGHT, GAP, ROW, MARGIN, LINE_GAP = 104, 26, 14, 62, 20, 12
ORDER_SWEEPS, STRAIGHTEN_SWEEPS = 60, 600
COLORS = ["#cfe3f7", "#d9efd0", "#fde8b8", "#f6d0d8", "#d3eeee", "#e2d6f3", "#d8dde2"]


def read_table(path):
    """Returns {room: rooms that it may include}, {room: number of its group} and the names of the
    groups."""
    below, group_of, groups, comment = {}, {}, [], ""
    for line in path.read_text().splitlines():
        if line.startswith("#"):
            comment = line[1:].partition(":")[0].strip()
        elif line[:1].isalpha():
            if comment:
                groups.append(comment)
                comment = ""
            room, rooms, _ = (part.strip() for part in line.split(":"))
            below[room], group_of[room] = rooms.split(), len(groups) - 1
        elif line.startswith(" "):
            below[room] += line.split()
        else:
            comment = ""
    return below, group_of, groups


def reduce_edges(below):
    """Leaves out what follows from other lines: a -> c where a -> b -> c."""
    reached = {}
    for room, rooms in below.items():  # rooms of a row stand above it
        reached[room] = set(rooms).union(*(reached[r] for r in rooms))
    return {room: [r for r in rooms if not any(r in reached[other] for other in rooms)]
            for room, rooms in below.items()}


def place_in_rows(below):
    """Returns rows of nodes, top down, and the pairs of nodes in neighbouring rows that a line
    joins.

    A node is a room, or a tuple where a line passes through a row.
    """
    row_of = {}
    for room, rooms in below.items():
        row_of[room] = 1 + max((row_of[r] for r in rooms), default=-1)
    rows = [[room for room in below if row_of[room] == i] for i in range(max(row_of.values()) + 1)]
    pieces = []
    for room, rooms in below.items():
        for target in rooms:
            chain = [target]
            for row in range(row_of[target] + 1, row_of[room]):
                chain.append((target, row))  # lines to one room share their way
                if chain[-1] not in rows[row]:
                    rows[row].append(chain[-1])
            chain.append(room)
            pieces += [pair for pair in zip(chain, chain[1:]) if pair not in pieces]
    return rows, pieces


def width_of(node):
    return BOX_WIDTH if isinstance(node, str) else LINE_GAP


def offsets(nodes):
    """Places of the nodes' middles, the first at 0, as close as they may stand."""
    out = [0.0]
    for a, b in zip(nodes, nodes[1:]):
        out.append(out[-1] + (width_of(a) + width_of(b)) / 2 + GAP)
    return out


def spread(row, wanted):
    """Puts a row's nodes, left to right, as near to the wanted places as their widths let them."""
    blocks = []  # (nodes that touch, place of the first)
    for node in row:
        nodes, first = [node], wanted[node]
        while blocks and blocks[-1][1] + offsets(blocks[-1][0] + nodes)[len(blocks[-1][0])] > first:
            nodes = blocks.pop()[0] + nodes
            first = sum(wanted[n] - o for n, o in zip(nodes, offsets(nodes))) / len(nodes)
        blocks.append((nodes, first))
    return {n: first + o for nodes, first in blocks for n, o in zip(nodes, offsets(nodes))}


def neighbours_of(pieces):
    """Returns the nodes that lines join each node to in the row above it, and in the row below
    it."""
    above, below = {}, {}
    for high, low in pieces:
        above.setdefault(low, []).append(high)
        below.setdefault(high, []).append(low)
    return above, below


def count_crossings(rows, pieces):
    place = {node: i for row in rows for i, node in enumerate(row)}
    row_of = {node: i for i, row in enumerate(rows) for node in row}
    lines = [(row_of[high], place[high], place[low]) for high, low in pieces]
    return sum(a[0] == b[0] and (a[1] - b[1]) * (a[2] - b[2]) < 0 for i, a in enumerate(lines)
               for b in lines[:i])


def order_rows(rows, pieces):
    """Sorts each row by the mean place of the nodes above, then below, and so on; returns the order
    with the fewest crossings."""
    above, below = neighbours_of(pieces)
    best, fewest = rows, count_crossings(rows, pieces)
    for sweep in range(ORDER_SWEEPS):
        near, around = (above, rows) if sweep % 2 == 0 else (below, rows[::-1])
        place = {node: i for row in rows for i, node in enumerate(row)}
        for row in around:
            def mean_place(node):
                places = [place[n] for n in near.get(node, [])]
                return sum(places) / len(places) if places else place[node]
            row.sort(key=mean_place)
            place.update({node: i for i, node in enumerate(row)})
        crossings = count_crossings(rows, pieces)
        if crossings < fewest:
            best, fewest = [list(row) for row in rows], crossings
    return best


def straighten(rows, pieces):
    """Returns each node's x, which is near to its neighbours'. Where a line only passes it is
    nearest, so that long lines are straight."""
    above, below = neighbours_of(pieces)
    x = {node: place for row in rows for node, place in zip(row, offsets(row))}
    for _ in range(STRAIGHTEN_SWEEPS):
        middle = sum(x.values()) / len(
            x)  # pulls a little, so that parts with few lines do not drift away
        for row in rows + rows[::-1]:
            wanted = {}
            for node in row:
                near = [(x[n], 1 if isinstance(n, str) else 30)
                        for n in above.get(node, []) + below.get(node, [])]
                near.append((middle, 0.3))
                weight = sum(w for _, w in near)
                wanted[node] = sum(place * w for place, w in near) / weight
            x.update(spread(row, wanted))
    left = min(x[n] - width_of(n) / 2 for n in x)
    return {node: round(MARGIN + place - left) for node, place in x.items()}


def draw(below, group_of, groups):
    rows, pieces = place_in_rows(reduce_edges(below))
    rows = order_rows(rows, pieces)
    x = straighten(rows, pieces)
    y = {node: MARGIN + i * ROW for i, row in enumerate(rows) for node in row}
    legend = MARGIN + len(rows) * ROW
    width = max(x[n] + width_of(n) // 2 for n in x) + MARGIN
    height = legend + 24 * len(groups) + MARGIN
    out = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" height="{height}"'
        ' font-family="sans-serif" font-size="12">',
        f'<rect width="{width}" height="{height}" fill="#ffffff"/>'
    ]
    for high, low in pieces:
        top, bottom, bend = y[high] + BOX_HEIGHT, y[low], ROW // 3
        out.append(
            f'<path d="M{x[high]} {top}C{x[high]} {top + bend} {x[low]} {bottom - bend} {x[low]} {bottom}"'
            ' fill="none" stroke="#7a8794" stroke-width="1.3"/>')
    for node in x:
        if isinstance(node, tuple):  # through the row
            out.append(
                f'<path d="M{x[node]} {y[node]}v{BOX_HEIGHT}" stroke="#7a8794" stroke-width="1.3"/>'
            )
    for room, group in group_of.items():
        out.append(
            f'<rect x="{x[room] - BOX_WIDTH // 2}" y="{y[room]}" width="{BOX_WIDTH}" height="{BOX_HEIGHT}"'
            f' rx="4" fill="{COLORS[group]}" stroke="#4a5560"/>')
        out.append(f'<text x="{x[room]}" y="{y[room] + 17}" text-anchor="middle">{room}</text>')
    for i, name in enumerate(groups):
        out.append(
            f'<rect x="{MARGIN}" y="{legend + 24 * i}" width="22" height="16" rx="3" fill="{COLORS[i]}"'
            ' stroke="#4a5560"/>')
        out.append(f'<text x="{MARGIN + 30}" y="{legend + 24 * i + 13}">{name}</text>')
    return "\n".join(out) + "\n</svg>\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("picture",
                        nargs="?",
                        type=pathlib.Path,
                        default=ROOT / "docs/images/rooms.svg")
    parser.add_argument("--check",
                        action="store_true",
                        help="only compare with the picture that is there")
    arguments = parser.parse_args()
    text = draw(*read_table(ROOT / "cmake/layers.txt"))
    if not arguments.check:
        arguments.picture.write_text(text)
    elif not arguments.picture.exists() or arguments.picture.read_text() != text:
        sys.exit(
            f"{arguments.picture}: not what cmake/layers.txt gives; run python3 tools/draw_rooms.py"
        )


if __name__ == "__main__":
    main()
