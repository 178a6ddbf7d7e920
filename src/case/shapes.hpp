// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/// Includes all shapes of bodies (docs/manual/input_reference.md).

#include "src/case/shapes/array.hpp"            // IWYU pragma: export
#include "src/case/shapes/box.hpp"              // IWYU pragma: export
#include "src/case/shapes/cone.hpp"             // IWYU pragma: export
#include "src/case/shapes/cylinder.hpp"         // IWYU pragma: export
#include "src/case/shapes/difference.hpp"       // IWYU pragma: export
#include "src/case/shapes/extrude.hpp"          // IWYU pragma: export
#include "src/case/shapes/foam.hpp"             // IWYU pragma: export
#include "src/case/shapes/half_space.hpp"       // IWYU pragma: export
#include "src/case/shapes/image.hpp"            // IWYU pragma: export
#include "src/case/shapes/intersection.hpp"     // IWYU pragma: export
#include "src/case/shapes/minimal_surface.hpp"  // IWYU pragma: export
#include "src/case/shapes/moved.hpp"            // IWYU pragma: export
#include "src/case/shapes/ogive.hpp"            // IWYU pragma: export
#include "src/case/shapes/packing.hpp"          // IWYU pragma: export
#include "src/case/shapes/points.hpp"           // IWYU pragma: export
#include "src/case/shapes/prism.hpp"            // IWYU pragma: export
#include "src/case/shapes/revolve.hpp"          // IWYU pragma: export
#include "src/case/shapes/scaled.hpp"           // IWYU pragma: export
#include "src/case/shapes/sphere.hpp"           // IWYU pragma: export
#include "src/case/shapes/surface.hpp"          // IWYU pragma: export
#include "src/case/shapes/tube.hpp"             // IWYU pragma: export
#include "src/case/shapes/union.hpp"            // IWYU pragma: export
