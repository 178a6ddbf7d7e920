// SPDX-License-Identifier: BSD-3-Clause
#include "src/solver/device/device.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "src/case/section.hpp"
#include "src/device/contact/constants.hpp"
#include "src/device/engine.hpp"
#include "src/device/material/describe.hpp"

namespace whipple::solver {
namespace {

using cases::Faults;

constexpr const char* elsewhere =
    "--device gpu and emulated do not compute it (docs/manual/devices.md); --device cpu does";

/// Adds a fault if a condition holds.
void refuse_if(bool condition, const Faults& faults, const char* key, const std::string& what) {
  if (condition) faults.add(key, fmt::format("{}: {}", what, elsewhere));
}

void check_scheme(const cases::Case& setup, const Faults& faults) {
  const cases::TransferControl& transfer = setup.transfer;
  refuse_if(setup.time.scheme != cases::Scheme::symplectic, faults, "time.scheme",
            "a scheme other than \"symplectic\"");
  refuse_if(transfer.shape_function != transfer::ShapeFunction::quadratic_bspline, faults,
            "transfer.shape_function", "a shape function other than \"quadratic_bspline\"");
  refuse_if(transfer.particle_update != cases::ParticleUpdate::relaxed_affine, faults,
            "transfer.particle_update", "a particle update other than \"relaxed_affine\"");
  refuse_if(transfer.affine_field != cases::AffineTransport::deformed, faults, "transfer.affine_field",
            "an affine field that is only turned");
  refuse_if(transfer.random_shift, faults, "transfer.random_shift", "a grid that is shifted");
  refuse_if(!setup.domain.refinement.empty(), faults, "domain.refinement", "a grid of two cell sizes");
  refuse_if(transfer.free_flight, faults, "transfer.free_flight", "free flight of single particles");
  refuse_if(!setup.dissipation.keeps_losses(), faults, "dissipation.losses",
            "losses that become heat at once");
  refuse_if(setup.heat.conduction, faults, "heat.conduction", "heat conduction between particles");
  refuse_if(setup.damping.coefficient > 0.0, faults, "damping", "local damping");
}

void check_loads(const cases::Case& setup, const Faults& faults) {
  refuse_if(!setup.loads.empty(), faults, "load", "a load other than gravity");
  refuse_if(!setup.force_gauges.empty(), faults, "force_gauge", "a force gauge");
  refuse_if(setup.has_burn(), faults, "detonation", "an explosive that burns");
  refuse_if(std::ranges::any_of(setup.bodies, [](const auto& b) { return b.strength_scatter.given(); }),
            faults, "body", "a body with strength_scatter");
  refuse_if(setup.has_elements() || setup.has_bars(), faults, "body", "a body of elements or bars");
}

void check_contact(const cases::Case& setup, const Faults& faults) {
  const cases::ContactFields& fields = setup.contact_fields;
  refuse_if(!fields.cracked.empty(), faults, "body", "a body that is divided at cracks");
  refuse_if(setup.contact.normal == contact::Normal::logistic_regression, faults, "contact.normal",
            "contact with normals by logistic regression");
  if (fields.several() && cases::count_of(fields.of_body) > device::most_contact_fields) {
    faults.add("body",
               fmt::format("more than {} velocity fields: {}", device::most_contact_fields, elsewhere));
  }
}

}  // namespace

Device& default_device() {
  static Device device = Device::cpu;
  return device;
}

void require(Device device) {
  if (device != Device::gpu) return;
  if (!device::has_gpu_engine()) {
    throw InputError(
        "--device gpu: this program was built without the compiler of a graphics processor (nvcc 12 or "
        "later); accepted here: cpu, reference, emulated");
  }
  if (!device::find_card()) {
    throw InputError(
        "--device gpu: this machine has no graphics processor, or no driver for CUDA "
        "programs; accepted here: cpu, reference, emulated");
  }
}

std::vector<InputFault> device_faults(const cases::Case& setup) {
  std::vector<InputFault> list;
  const Faults faults(list);
  check_scheme(setup, faults);
  check_loads(setup, faults);
  check_contact(setup, faults);
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    const Faults of_body = faults.in("body").in(b);
    const cases::Body& body = setup.bodies[b];
    refuse_if(body.driven || !body.node_conditions.empty(), of_body, "driven", "a driven body");
    refuse_if(body.volumetric == cases::Volumetric::cell, of_body, "volumetric", "means over cells");
    for (const std::string& text : device::refusals(*setup.materials[b])) of_body.add("material", text);
  }
  return list;
}

void evaluate_by_tables(cases::Case& setup) {
  for (std::size_t b = 0; b < setup.bodies.size(); ++b) {
    if (device::needs_table(*setup.materials[b]))
      setup.bodies[b].equation_of_state = cases::Evaluation::table;
  }
}

}  // namespace whipple::solver
