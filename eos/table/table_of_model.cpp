// SPDX-License-Identifier: BSD-3-Clause
#include "eos/table/table_of_model.hpp"

#include <cmath>
#include <utility>

namespace whipple::eos {

TableOfModel::TableOfModel(Table table, std::shared_ptr<const EquationOfState> model)
    : table_(std::move(table)), model_(std::move(model)) {}

bool TableOfModel::holds(double density) const {
  return density >= table_.minimum_density() && density <= table_.maximum_density();
}

double TableOfModel::minimum_energy(double density) const {
  return holds(density) ? table_.minimum_energy(density) : model_->minimum_energy(density);
}

RangeReport TableOfModel::evaluate(const Batch& batch) const {
  RangeReport report = table_.evaluate(batch);
  if (report.out_of_range == 0) return report;
  report.out_of_range = 0;
  report.first = RangeReport::none;
  report.bound = "";
  for (std::size_t i = 0; i < batch.density.size(); ++i) {
    if (!std::isnan(batch.temperature[i])) continue;
    const auto one = [i](auto values) { return values.empty() ? values : values.subspan(i, 1); };
    RangeReport of_point =
        model_->evaluate({one(batch.density), one(batch.specific_internal_energy), one(batch.pressure),
                          one(batch.temperature), one(batch.sound_speed), one(batch.melted_fraction),
                          one(batch.vaporised_fraction), one(batch.distension)});
    if (of_point.first != RangeReport::none) of_point.first = i;
    report.merge(of_point);
  }
  return report;
}

State TableOfModel::state(double density, double specific_internal_energy) const {
  const bool in_table = holds(density) && specific_internal_energy <= table_.maximum_energy(density);
  return in_table ? table_.state(density, specific_internal_energy)
                  : model_->state(density, specific_internal_energy);
}

State TableOfModel::state_at_temperature(double density, double temperature) const {
  const bool in_table = holds(density) && temperature <= table_.data().greatest_temperature;
  return in_table ? table_.state_at_temperature(density, temperature)
                  : model_->state_at_temperature(density, temperature);
}

}  // namespace whipple::eos
