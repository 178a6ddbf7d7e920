#!/usr/bin/python3
# SPDX-License-Identifier: BSD-3-Clause
"""The one set of numerical parameters, and every case that departs from it.

usage: frozen_parameters.py [--defaults] [--digest]

The set is that of the defaults of the program, as docs/manual/input_reference.md has them (a test keeps that page equal to
`whipple describe --markdown`). A case may depart from it only with a reason in [overrides] of its expected.toml; a run
marked `sensitivity = true` may depart freely, for it counts in no summary. Lists all departures; exit code 1 if one has
no reason, or a reason has no departure.
"""
import argparse
import pathlib
import sys

# The modules of the project are imported from its root.
sys.path[0] = str(pathlib.Path(__file__).resolve().parents[1])
from studies.validation.cases import BadExpectation, all_cases  # noqa: E402
from studies.validation.frozen_parameters import check, defaults, departures, digest  # noqa: E402


def main():
    parser = argparse.ArgumentParser(prog="frozen_parameters.py",
                                     description="Lists the departures of the cases from the numerical parameters.")
    parser.add_argument("--defaults", action="store_true", help="print the set")
    parser.add_argument("--digest", action="store_true", help="print its digest")
    arguments = parser.parse_args()
    try:
        parameters = defaults()
        if arguments.defaults or arguments.digest:
            for key, value in parameters.items() if arguments.defaults else ():
                print(f"{key} = {value}")
            print(f"digest {digest(parameters)}")
            return 0
        cases = all_cases()
        for case in cases:
            for where, key, value, reason in departures(case, parameters):
                print(f"{case.name}, {where}: {key} = {value}\n    {reason or 'NO REASON'}")
            for run in case.runs:
                if run.sensitivity:
                    print(f"{case.name}:{run.name} (sensitivity): {'; '.join(run.set)}")
        wrong = check(cases, parameters)
    except BadExpectation as error:
        print(f"frozen_parameters.py: error: {error}", file=sys.stderr)
        return 2
    for text in wrong:
        print(f"frozen_parameters.py: {text}", file=sys.stderr)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
