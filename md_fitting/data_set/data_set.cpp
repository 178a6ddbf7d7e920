// SPDX-License-Identifier: BSD-3-Clause
#include "md_fitting/data_set/data_set.hpp"
