# SPDX-License-Identifier: BSD-3-Clause
"""Types of whipple."""
from . import eos as eos
from .runs import Case as Case
from .runs import CaseError as CaseError
from .runs import Fault as Fault
from .runs import Quantity as Quantity
from .runs import Results as Results
from .runs import Run as Run
from .runs import RunError as RunError
from .runs import StudyResults as StudyResults
from .runs import Table as Table
from .runs import materials as materials
from .runs import program as program
from .runs import sweep as sweep
