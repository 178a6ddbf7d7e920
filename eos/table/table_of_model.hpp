// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "eos/table/table.hpp"

namespace whipple::eos {

/// Combines a table with its model: states outside the table - less dense vapour, or material above its maximum
/// temperature, as may occur at first contact in a fast impact - are computed by the model. For runs, which must
/// not stop at the edge of a table.
class TableOfModel final : public EquationOfState {
 public:
  /// @param table table of this model
  TableOfModel(Table table, std::shared_ptr<const EquationOfState> model);

  [[nodiscard]] const Table& table() const { return table_; }

  [[nodiscard]] std::string_view model() const override { return Table::name; }
  [[nodiscard]] double reference_density() const override { return table_.reference_density(); }
  [[nodiscard]] double reference_temperature() const override { return table_.reference_temperature(); }
  [[nodiscard]] double reference_energy() const override { return table_.reference_energy(); }
  [[nodiscard]] bool condensed() const override { return table_.condensed(); }
  [[nodiscard]] double maximum_density() const override { return model_->maximum_density(); }
  [[nodiscard]] double minimum_energy(double density) const override;
  [[nodiscard]] double least_temperature() const override { return table_.least_temperature(); }
  RangeReport evaluate(const Batch& batch) const override;
  [[nodiscard]] State state(double density, double specific_internal_energy) const override;
  [[nodiscard]] State state_at_temperature(double density, double temperature) const override;
  [[nodiscard]] std::string constants() const override { return table_.constants(); }

 private:
  [[nodiscard]] bool holds(double density) const;

  Table table_;
  std::shared_ptr<const EquationOfState> model_;
};

}  // namespace whipple::eos
