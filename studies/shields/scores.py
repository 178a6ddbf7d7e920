# SPDX-License-Identifier: BSD-3-Clause
"""Statistics of predictions that are right or wrong: intervals, confusion tables, paired comparisons."""
import dataclasses
import math

NORMAL_95 = 1.959963984540054  # quantile 0.975 of the normal distribution


def wilson(right, count):
    """Interval of 95 % of a fraction by Wilson, J. Am. Stat. Assoc. 22 (1927) 209; (nan, nan) of nothing."""
    if count == 0:
        return math.nan, math.nan
    z2 = NORMAL_95**2
    share = right / count
    middle = (share + z2 / (2 * count)) / (1 + z2 / count)
    half = NORMAL_95 / (1 + z2 / count) * math.sqrt(share * (1 - share) / count + z2 / (4 * count**2))
    return middle - half, middle + half


def mcnemar(first_alone, second_alone):
    """Two-sided exact probability that two equally good predictions differ so much: the binomial distribution of the shots
    that one of them alone has right (McNemar, Psychometrika 12 (1947) 153); 1 without such shots."""
    count = first_alone + second_alone
    tail = sum(math.comb(count, k) for k in range(min(first_alone, second_alone) + 1)) / 2**count
    return min(1.0, 2 * tail)


def fisher(a, b, c, d):
    """Two-sided exact probability of a table ((a, b), (c, d)) where rows and columns are independent: the sum over the tables with the same
    margins that are no more probable (Fisher, J. R. Stat. Soc. 85 (1922) 87)."""
    first, second, column = a + b, c + d, a + c
    total = math.comb(first + second, column)

    def ways(k):
        return math.comb(first, k) * math.comb(second, column - k)

    own = ways(a)
    return sum(ways(k) for k in range(max(0, column - second), min(first, column) + 1) if ways(k) <= own) / total


def separation(values, answers):
    """Probability that a value of a shot with the answer True is larger than that of one with False, ties half (area under the curve of
    Hanley and McNeil, Radiology 143 (1982) 29): 0.5 says nothing, 0 or 1 all; nan without one of them."""
    yes, no = ([value for value, answer in zip(values, answers) if answer == wanted] for wanted in (True, False))
    return sum((a > b) + 0.5 * (a == b) for a in yes for b in no) / (len(yes) * len(no)) if yes and no else math.nan


@dataclasses.dataclass
class Confusion:
    """Numbers of shots by what was measured (P: failed, NP: held) and what was predicted."""
    hit: int = 0      # P, predicted P
    unsafe: int = 0   # P, predicted NP
    alarm: int = 0    # NP, predicted P
    held: int = 0     # NP, predicted NP

    def add(self, failed, predicted):
        name = ("hit" if predicted else "unsafe") if failed else ("alarm" if predicted else "held")
        setattr(self, name, getattr(self, name) + 1)

    @property
    def count(self):
        return self.hit + self.unsafe + self.alarm + self.held

    @property
    def right(self):
        return self.hit + self.held

    @property
    def majority(self):
        """Number of shots that the more frequent result alone has right."""
        return max(self.hit + self.unsafe, self.alarm + self.held)


def confusion(shots, prediction):
    """Confusion table of the shots that `prediction` says something about: True, False, or None."""
    table = Confusion()
    for shot in shots:
        predicted = prediction(shot)
        if predicted is not None:
            table.add(shot.failed, predicted)
    return table


def paired(shots, first, second):
    """Numbers of shots that both, the first alone, the second alone and neither has right, where both say something."""
    numbers = {(True, True): 0, (True, False): 0, (False, True): 0, (False, False): 0}
    for shot in shots:
        answers = first(shot), second(shot)
        if None not in answers:
            numbers[answers[0] == shot.failed, answers[1] == shot.failed] += 1
    return numbers[True, True], numbers[True, False], numbers[False, True], numbers[False, False]


def percent(right, count):
    """Text "68.5 % (64.0 to 72.8)" of a fraction with its interval; "-" of nothing."""
    if count == 0:
        return "-"
    low, high = wilson(right, count)
    return f"{100 * right / count:.1f} % ({100 * max(low, 0.0):.1f} to {100 * high:.1f})"


def table(head, rows):
    return ["| " + " | ".join(head) + " |", "|" + " --- |" * len(head),
            *("| " + " | ".join(map(str, row)) + " |" for row in rows), ""]
