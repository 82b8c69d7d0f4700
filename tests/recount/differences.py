# SPDX-License-Identifier: GPL-3.0-or-later
"""The largest difference of each figure over all recounted tests: `recount_test.py --differences FILE`."""

import re


class Differences:
    def __init__(self):
        self.figures = {}  # by name: number of comparisons, tests, and the difference and tolerance with the largest ratio

    def take(self, folder, lines):
        for name, stated, ours, difference, tolerance, _ in lines:
            if stated != stated and ours != ours:
                continue  # both are NaN, which says nothing about the figure
            name = re.sub(r"^frame \d+:", "frames:", re.sub(r" \[\d+ of \d+\]$", "", name))
            name = re.sub(r"^(minerals\[)\d+\]", r"\1]", name)
            seen = self.figures.setdefault(name, [0, set(), 0.0, tolerance])
            seen[0] += 1
            seen[1].add(folder)
            if difference * seen[3] > seen[2] * tolerance or (difference > seen[2] and tolerance == 0):
                seen[2:] = difference, tolerance

    def write(self, path):
        lines = [
            "# The largest differences seen",
            "",
            "Made by `tests/recount/recount_test.py --differences tests/recount/differences.md`.",
            "",
            "Every figure that the tests recount, in how many tests and how often (a column of the curve or of events is one figure: its worst row stands for all), and the",
            "comparison that came nearest to its tolerance. Difference and tolerance have the figure's unit; «exact» is a number that is counted, a word, or a statement that holds.",
            "What is null in the summary and not defined for the recount either is not counted: no test of it has a value.",
            "",
            "| figure | tests | compared | largest difference | tolerance there | share of it |",
            "| --- | --- | --- | --- | --- | --- |",
        ]
        for name in sorted(self.figures):
            compared, tests, difference, tolerance = self.figures[name]
            exact = tolerance == 0
            share = "" if exact else f"{difference / tolerance:.0%}" if difference else "0"
            lines.append(f"| {name} | {len(tests)} | {compared} | {f'{difference:.1e}' if difference else '0'} | {'exact' if exact else f'{tolerance:.1e}'} | {share} |")
        path.write_text("\n".join(lines) + "\n")
