// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "src/core/base/temporary_folder.hpp"
