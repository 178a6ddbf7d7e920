# SPDX-License-Identifier: BSD-3-Clause
"""A queue of all computations behind the tables: resumable, in the order of their value, within a given time.

Whatever is current, here or in docs/generated/results, is not computed again, so that a queue that was stopped goes on
where it was. A run is completed before the next one is begun: tables of one program are worth more than parts of many. What
no table has yet comes last.
"""
import concurrent.futures
import threading
import time
from dataclasses import dataclass

from studies.validation import comparison, execution, provenance
from studies.validation.cases import BadExpectation
from studies.validation.variants import variants_of

UNKNOWN_COST = 60.0  # s, of what was never run


@dataclass
class Job:
    """One computation: a variant of a run and what it is expected to take (s on one thread)."""
    case: object
    run: object
    variant: object
    cost: float

    @property
    def name(self):
        return f"{self.case.name}:{self.run.name}.{self.variant.name}"


def rank(run):
    """Verdicts first: headlines that decide, other runs that decide, those that finer sections decide, sensitivities."""
    if run.sensitivity:
        return 3
    if run.decided_by:
        return 2
    return 0 if run.headline else 1


def stored_run(results, case, run):
    entries = results["cases"].get(case.name, {}).get("runs", [])
    return next((entry for entry in entries if entry["name"] == run.name), None)


def is_stored(entry, run, variant, source):
    """Whether the stored results hold this variant as this program computes it."""
    record = entry["records"].get(variant.name) if entry else None
    return (record is not None and provenance.is_current(record["source"], source, run) and entry["inputs"] == provenance.inputs_of(run)
            and record["cell_size"] == run.cell_size[variant.resolution])


def plan(results, chosen, source):
    """What is left to compute, in order: what tables have, by rank, then the runs that take least, all variants of one
    together; then the same of what was never computed. source: digest of the program that will compute them."""
    of_run, never = [], []
    for case, run in chosen:
        entry, jobs = stored_run(results, case, run), []
        records = entry["records"] if entry else {}
        known = [variant for variant in comparison.extra_grids(run) if variant.name in records]
        for variant in variants_of(run, band=True) + known:
            _, state = execution.state_of(case, run, variant, execution.folder_of(case, run, variant), (), source)
            if state == provenance.CURRENT or is_stored(entry, run, variant, source):
                continue
            record = records.get(variant.name)
            if record:
                jobs.append(Job(case, run, variant, record["wall_time"] * record["threads"]))
            else:
                never.append(Job(case, run, variant, UNKNOWN_COST))
        if jobs:
            of_run.append((rank(run), sum(job.cost for job in jobs), sorted(jobs, key=lambda job: job.cost)))
    of_run.sort(key=lambda entry: entry[:2])
    return [job for _, _, jobs in of_run for job in jobs] + sorted(never, key=lambda job: rank(job.run))


class Clock:
    """Says whether a job still fits, from how much longer than expected the finished ones took."""

    def __init__(self, seconds):
        self.end = time.monotonic() + seconds
        self.lock = threading.Lock()
        self.expected = self.taken = 1.0

    def left(self):
        return self.end - time.monotonic()

    def fits(self, job):
        with self.lock:
            return job.cost * self.taken / self.expected < self.left()

    def learn(self, job, seconds):
        with self.lock:
            self.expected += job.cost
            self.taken += seconds


def work_off(jobs, whipple, minutes, at_once, write, write_every=600.0):
    """Compute jobs, `at_once` of them on one thread each, as long as they fit into the time.

    write(chosen): called with the cases and runs that have news, every `write_every` seconds and at the end.
    Returns the jobs that failed and those that did not fit.
    """
    clock, news, failed, left = Clock(60.0 * minutes), [], [], []
    begin = written = time.monotonic()

    def compute(job):
        if not clock.fits(job):
            return job, "left"
        start = time.monotonic()
        folder = execution.folder_of(job.case, job.run, job.variant)
        done = execution.execute(whipple, job.case, job.run, job.variant, 1) and execution.analyse(whipple, folder, job.run, 1)
        clock.learn(job, time.monotonic() - start)
        return job, "done" if done else "failed"

    pool = concurrent.futures.ThreadPoolExecutor(at_once)
    try:
        for number, future in enumerate(concurrent.futures.as_completed([pool.submit(compute, job) for job in jobs]), 1):
            job, outcome = future.result()
            {"done": news, "failed": failed, "left": left}[outcome].append(job)
            print(f"{number} of {len(jobs)}, {(time.monotonic() - begin) / 60:.0f} of {minutes:g} min: {job.name} {outcome}",
                  flush=True)
            if news and time.monotonic() - written > write_every:
                try:
                    write(changed(news))
                    news, written = [], time.monotonic()
                except BadExpectation:  # another variant of these runs has ended and is being measured: with the next one
                    continue
    finally:
        pool.shutdown(cancel_futures=True)
    if news:
        write(changed(news))
    return failed, left


def changed(jobs):
    """The cases and runs of jobs, each once."""
    found = {(job.case.name, job.run.name): (job.case, job.run) for job in jobs}
    return list(found.values())
