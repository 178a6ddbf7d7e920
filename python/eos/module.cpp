// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/ranges.h>

#include <algorithm>

#include "eos/audit.hpp"
#include "eos/curves/queries.hpp"
#include "eos/files/table_file.hpp"
#include "eos/table/builder.hpp"
#include "python/eos/bindings.hpp"
#include "python/eos/pickling.hpp"
#include "python/eos/states.hpp"
#include "src/core/base/log.hpp"
#include "src/material/material_file.hpp"
#include "src/material/material_samples.hpp"

namespace whipple::python {
namespace {

/// Holds the result of a batch evaluation: arrays of one shape.
struct Evaluation {
  Numbers pressure, temperature, sound_speed, melted_fraction, vaporised_fraction;
  Shape shape;

  explicit Evaluation(const Shape& shape_)
      : pressure(shape_),
        temperature(shape_),
        sound_speed(shape_),
        melted_fraction(shape_),
        vaporised_fraction(shape_),
        shape(shape_) {}

  [[nodiscard]] std::array<Numbers*, 5> columns() {
    return {&pressure, &temperature, &sound_speed, &melted_fraction, &vaporised_fraction};
  }
};

py::tuple packed(const Evaluation& evaluation) {
  Evaluation copy = evaluation;  // its columns refer to the same arrays
  py::list columns;
  for (const Numbers* column : copy.columns()) columns.append(*column);
  return py::make_tuple(py::tuple(py::cast(evaluation.shape)), columns);
}

Evaluation unpacked(const py::tuple& pack) {
  const auto refuse = [] { throw InputError("a pickle of an evaluation of another version"); };
  if (pack.size() != 2) refuse();
  Evaluation result(pack[0].cast<Shape>());
  const auto columns = pack[1].cast<std::vector<Numbers>>();
  if (columns.size() != result.columns().size()) refuse();
  for (std::size_t k = 0; k < columns.size(); ++k) {
    if (!std::ranges::equal(std::span(columns[k].shape(), static_cast<std::size_t>(columns[k].ndim())),
                            result.shape)) {
      refuse();
    }
    *result.columns()[k] = columns[k];
  }
  return result;
}

/// Returns a copy with separate arrays.
Evaluation copy_of(const Evaluation& evaluation) {
  Evaluation copy = evaluation;
  for (Numbers* column : copy.columns()) *column = Numbers(column->attr("copy")());
  return copy;
}

/// Evaluates points one by one where some points of a batch have no state, and sets those to NaN.
void skip_points_out_of_range(const eos::EquationOfState& eos, const eos::Batch& batch) {
  for (std::size_t i = 0; i < batch.density.size(); ++i) {
    const eos::Batch one{batch.density.subspan(i, 1),           batch.specific_internal_energy.subspan(i, 1),
                         batch.pressure.subspan(i, 1),          batch.temperature.subspan(i, 1),
                         batch.sound_speed.subspan(i, 1),       batch.melted_fraction.subspan(i, 1),
                         batch.vaporised_fraction.subspan(i, 1)};
    if (eos.evaluate(one).out_of_range == 0) continue;
    for (const std::span<double> column :
         {one.pressure, one.temperature, one.sound_speed, one.melted_fraction, one.vaporised_fraction}) {
      column[0] = eos::State::unknown;
    }
  }
}

Evaluation evaluate(const Material& material, const Numbers& density, const Numbers& energy, Evaluation* out,
                    bool skip_invalid) {
  const Points points = broadcast({density, energy});
  if (out != nullptr && out->shape != points.shape) {
    throw InputError("evaluate: the arrays of 'out' have another shape than density and energy together");
  }
  Evaluation result = out != nullptr ? *out : Evaluation(points.shape);
  std::array<std::span<double>, 5> columns;
  for (std::size_t k = 0; k < columns.size(); ++k)
    columns[k] = {result.columns()[k]->mutable_data(), points.size};
  const eos::Batch batch{points.column(0), points.column(1), columns[0], columns[1],
                         columns[2],       columns[3],       columns[4]};
  py::gil_scoped_release unlocked;
  const eos::RangeReport report = material.eos->evaluate(batch);
  if (report.out_of_range > 0) {
    if (!skip_invalid) {
      const std::size_t i = report.first;
      throw StateError(
          fmt::format("{} of {} points are out of the range of model {} ({}); the first is {}: {:.6g} "
                      "kg/m^3, {:.6g} J/kg",
                      report.out_of_range, points.size, material.eos->model(), report.bound, i,
                      points.column(0)[i], points.column(1)[i]));
    }
    skip_points_out_of_range(*material.eos, batch);
  }
  return result;
}

States states(const Material& material, const OptionalNumbers& density, const OptionalNumbers& temperature,
              const OptionalNumbers& energy, const OptionalNumbers& pressure, const OptionalNumbers& entropy,
              bool skip_invalid) {
  using eos::curves::StateQuery;
  std::vector<std::optional<double> StateQuery::*> given;
  const auto add = [&](const OptionalNumbers& numbers, std::optional<double> StateQuery::* member) {
    if (numbers) given.push_back(member);
  };
  add(density, &StateQuery::density);
  add(temperature, &StateQuery::temperature);
  add(energy, &StateQuery::energy);
  add(pressure, &StateQuery::pressure);
  add(entropy, &StateQuery::entropy);
  return states_of(material.eos, broadcast({density, temperature, energy, pressure, entropy}), skip_invalid,
                   [&](const std::vector<double>& inputs) {
                     StateQuery query;
                     for (std::size_t k = 0; k < given.size(); ++k) query.*given[k] = inputs[k];
                     return eos::curves::state_of(*material.eos, query);
                   });
}

/// Collects the sources of a table and of the tables in it.
/// @param name  of the table; empty: top level of the file
void add_sources(py::dict& sources, const std::string& name, const py::handle& item) {
  const std::string prefix = name.empty() ? "" : name + ".";
  if (py::isinstance<py::dict>(item)) {
    for (const auto& [key, value] : py::reinterpret_borrow<py::dict>(item)) {
      const std::string word = py::str(key);
      if (word == "source") sources[py::str(name.empty() ? "file" : name)] = value;
      add_sources(sources, prefix + word, value);
    }
  } else if (py::isinstance<py::list>(item)) {
    std::size_t i = 0;
    for (const py::handle& value : item) add_sources(sources, fmt::format("{}{}", prefix, i++), value);
  }
}

py::dict sources(const Material& material) {
  py::dict result;
  add_sources(result, "", py::module_::import("tomllib").attr("loads")(material_text(material.file)));
  return result;
}

States reference(const Material& material) { return {material.eos, {}, {material.reference}}; }

/// Returns the file of a library material by its key, its name or its entry in the list, or of a path.
std::filesystem::path file_of(const py::object& name) {
  if (py::isinstance<LibraryMaterial>(name)) return name.cast<const LibraryMaterial&>().file;
  const auto path = name.cast<std::filesystem::path>();
  try {
    return find_material(path);
  } catch (const InputError&) {
    std::vector<std::string> keys;
    std::filesystem::path found;
    for (const LibraryMaterial& entry : library_materials()) {
      if (entry.name != path.string()) continue;
      found = entry.file;
      keys.push_back(entry.file.stem().string());
    }
    if (keys.empty()) throw;
    if (keys.size() > 1) {
      throw InputError(
          fmt::format("'{}' is the name of several materials: {}", path.string(), fmt::join(keys, ", ")));
    }
    return found;
  }
}

py::object read(const py::object& name, const std::map<std::string, std::string>& changes) {
  const std::filesystem::path file = file_of(name);
  const std::vector<std::pair<std::string, std::string>> list(changes.begin(), changes.end());
  const auto unlocked = [&] {
    const py::gil_scoped_release released;
    return read_changed_material(file, list);
  };
  return material_of_file(unlocked(), list);
}

Material tabulated(const Material& material, double error,
                   const std::optional<std::pair<double, double>>& densities,
                   const std::optional<std::pair<double, double>>& temperatures,
                   const std::optional<std::filesystem::path>& file) {
  if (!(error >= 1e-8 && error <= 0.05)) {
    throw InputError(fmt::format("table: an error of {} is not between 1e-8 and 0.05", error));
  }
  eos::TableRequest request;
  request.error = error;
  if (densities) std::tie(request.minimum_density, request.maximum_density) = *densities;
  if (temperatures) std::tie(request.least_temperature, request.greatest_temperature) = *temperatures;
  py::gil_scoped_release unlocked;
  eos::TableFile table{eos::tabulate(*material.eos, request, eos::serial(), [](double) { check_signals(); }),
                       {}};
  if (file) eos::write_table(*file, table);
  return with_eos(material, std::make_shared<eos::Table>(std::move(table.data)));
}

/// Forwards the messages of the libraries to Python's module logging, under the name "whipple".
void pass_messages_to_python() {
  log::set_sink([](log::Kind kind, const std::string& message) {
    if (Py_IsInitialized() == 0) return;
    py::gil_scoped_acquire locked;
    const char* level = kind == log::Kind::warning       ? "warning"
                        : kind == log::Kind::information ? "info"
                                                         : "debug";
    py::module_::import("logging").attr("getLogger")("whipple").attr(level)("%s", with_paths(message));
  });
}

/// Raises an input error as a Python exception, with the locations of its faults.
void raise(const InputError& error, const py::handle& kind) {
  py::list faults;
  for (const InputFault& fault : error.faults()) {
    faults.append(py::dict(py::arg("file") = with_paths(fault.file), py::arg("line") = fault.line,
                           py::arg("column") = fault.column, py::arg("key") = fault.key,
                           py::arg("text") = with_paths(fault.text)));
  }
  py::object raised = kind(with_paths(error.what()));
  raised.attr("faults") = faults;
  PyErr_SetObject(kind.ptr(), raised.ptr());
}

void add_errors(py::module_& module) {
  // Exists as long as the process, like the translator that refers to it.
  static const py::handle input_error =
      py::exception<InputError>(module, "InputError", PyExc_ValueError).release();
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const InputError& error) {
      raise(error, input_error);
    }
  });
  input_error.doc() =
      "Wrong input: a material that does not exist, constants that contradict each other, quantities that "
      "name no\n"
      "state. faults: list of dictionaries with file, line, column, key and text.";
  py::register_exception<StateError>(module, "StateError", PyExc_ArithmeticError).doc() =
      "A state out of the range of its model.";
  py::register_exception<InternalError>(module, "InternalError", PyExc_RuntimeError).doc() =
      "A defect of the library.";
}

void add_validity(py::module_& module) {
  py::class_<eos::Audit>(module, "Audit", "Whether and where an equation of state describes its material.")
      .def_property_readonly("summary", &eos::Audit::summary,
                             "\"sound\", \"sound with reservations: ...\" or \"not usable: ...\".")
      .def_property_readonly(
          "usable", [](const eos::Audit& a) { return a.verdict() != eos::Verdict::not_usable; },
          "False if the constants describe no material.")
      .def_property_readonly("range", &eos::Audit::range_text, "The range of validity in words, with units.")
      .def_property_readonly(
          "densities",
          [](const eos::Audit& a) { return std::pair(a.range.least_density, a.range.greatest_density); },
          "Least and greatest density, kg/m^3.")
      .def_property_readonly(
          "temperatures",
          [](const eos::Audit& a) {
            return std::pair(a.range.least_temperature, a.range.greatest_temperature);
          },
          "Least and greatest temperature, K, on the isochore of the reference state.")
      .def_property_readonly(
          "strongest_shock", [](const eos::Audit& a) { return a.range.strongest_shock.state.pressure; },
          "Pressure of the strongest shock from the reference state, Pa.")
      .def_property_readonly(
          "findings",
          [](const eos::Audit& a) {
            std::vector<std::string> texts;
            for (const eos::Finding& finding : a.findings) texts.push_back(finding.text);
            return texts;
          },
          "What the audit objects to, with the numbers and the limits.");
}

void add_material(py::module_& module, py::class_<Material>& material) {
  py::class_<Evaluation>(module, "Evaluation",
                         "What a simulation asks of an equation of state, as arrays of one shape (SI).")
      .def_property_readonly(
          "pressure", [](const Evaluation& e) { return read_only(e.pressure); }, "Pressure, Pa.")
      .def_property_readonly(
          "temperature", [](const Evaluation& e) { return read_only(e.temperature); }, "Temperature, K.")
      .def_property_readonly(
          "sound_speed", [](const Evaluation& e) { return read_only(e.sound_speed); },
          "Isentropic (bulk) sound speed, m/s.")
      .def_property_readonly(
          "melted_fraction", [](const Evaluation& e) { return read_only(e.melted_fraction); },
          "Mass fraction of liquid and vapour, 0 to 1.")
      .def_property_readonly(
          "vaporised_fraction", [](const Evaluation& e) { return read_only(e.vaporised_fraction); },
          "Mass fraction of vapour, 0 to 1.")
      .def_property_readonly(
          "shape", [](const Evaluation& e) { return py::tuple(py::cast(e.shape)); }, "Shape of the arrays.")
      .def(
          "__len__",
          [](const Evaluation& e) {
            if (e.shape.empty()) throw py::type_error("a single point has no length");
            return e.shape.front();
          },
          "Number of points along the first axis.")
      .def("__copy__", [](const Evaluation& e) { return copy_of(e); })
      .def("__deepcopy__", [](const Evaluation& e, const py::dict&) { return copy_of(e); })
      .def(py::pickle([](const Evaluation& e) { return packed(e); }, &unpacked));

  material.def_readonly("name", &Material::name, "Name of the material.")
      .def_property_readonly(
          "file", [](const Material& m) { return with_paths(m.file.string()); },
          "The file that it was read from.")
      .def_readonly("source", &Material::source, "Where its constants come from.")
      .def_property_readonly(
          "sources", &sources,
          "Sources of the file and of each of its tables by name: \"file\", \"eos\", \"failure.0\".")
      .def_readonly("note", &Material::note, "Purpose or limits in one line.")
      .def_readonly("group", &Material::group, "Where the library lists it: \"metals\", \"explosives\", ...")
      .def_property_readonly(
          "model", [](const Material& m) { return std::string(m.eos->model()); },
          "Name of its equation of state.")
      .def_property_readonly(
          "constants", [](const Material& m) { return with_paths(m.constants()); },
          "The material as a material file (TOML), every default written out, with units.")
      .def_property_readonly(
          "measured_melting_point", [](const Material& m) { return m.measured.melting_point; },
          "Measured melting point (of an alloy: solidus) at 1 atm, K; NaN: not known.")
      .def_property_readonly(
          "measured_boiling_point", [](const Material& m) { return m.measured.boiling_point; },
          "Measured boiling point at 1 atm, K; NaN: not known.")
      .def_property_readonly("reference", &reference,
                             "The state that bodies start from: zero pressure at the reference temperature.")
      .def(
          "audit",
          [](const Material& m, bool full) {
            return eos::audit(*m.eos, full ? eos::AuditDepth::full : eos::AuditDepth::brief);
          },
          py::arg("full") = false, py::call_guard<py::gil_scoped_release>(),
          "Examine whether and where the equation of state is valid.\n\n"
          "full: also stability and thermodynamic identities over density and temperature (seconds).")
      .def("evaluate", &evaluate, py::arg("density"), py::arg("energy"), py::kw_only(),
           py::arg("out") = nullptr, py::arg("skip_invalid") = false,
           "Compute pressure, temperature, sound speed and phase fractions of many points as a simulation "
           "does.\n\n"
           "density: kg/m^3; energy: specific internal energy, J/kg; arrays that numpy can broadcast.\n"
           "out: an earlier result of the same shape, whose arrays are overwritten.\n"
           "skip_invalid: points out of the range of the model become NaN; else they raise StateError.\n"
           "Points colder than the least temperature of the model are held there, as in a simulation.")
      .def("states", &states, py::kw_only(), py::arg("density") = py::none(),
           py::arg("temperature") = py::none(), py::arg("energy") = py::none(),
           py::arg("pressure") = py::none(), py::arg("entropy") = py::none(), py::arg("skip_invalid") = false,
           "Compute states with all quantities that the model knows.\n\n"
           "Two quantities name a state: density (kg/m^3) with temperature (K), energy (J/kg), pressure (Pa) "
           "or\n"
           "entropy (J/(kg K)), or pressure with temperature; none: the reference state. Arrays that numpy "
           "can\n"
           "broadcast.\n"
           "skip_invalid: points without a state become NaN; else they raise StateError. Raises InputError "
           "for other\n"
           "combinations of quantities.")
      .def(
          "table",
          [](const py::object& self, double error, const std::optional<std::pair<double, double>>& densities,
             const std::optional<std::pair<double, double>>& temperatures,
             const std::optional<std::filesystem::path>& file) {
            // Unpickling rebuilds the table.
            const py::object again =
                py::module_::import("operator")
                    .attr("methodcaller")("table", error, py::arg("densities") = densities,
                                          py::arg("temperatures") = temperatures);
            return with_recipe(tabulated(self.cast<const Material&>(), error, densities, temperatures, file),
                               again, py::make_tuple(self));
          },
          py::arg("error") = 1e-4, py::kw_only(), py::arg("densities") = py::none(),
          py::arg("temperatures") = py::none(), py::arg("file") = py::none(),
          "Return the material with its equation of state tabulated.\n\n"
          "error: relative error of temperature and pressure, 1e-8 to 0.05.\n"
          "densities, temperatures: least and greatest, kg/m^3 and K; default: those of `whipple eos "
          "table`.\n"
          "file: also written there (NAME.eos.h5). Raises InputError if the model knows no entropy.")
      .def("__repr__", [](const Material& m) {
        return fmt::format("<material '{}', model {}>", m.name, m.eos->model());
      });
}

void add_library(py::module_& module) {
  py::class_<LibraryMaterial>(module, "LibraryMaterial", "A material of the library.")
      .def_property_readonly(
          "key", [](const LibraryMaterial& m) { return with_paths(m.file.stem().string()); },
          "The name that `material` takes.")
      // An unreadable file is listed with the reason, which includes its name.
      .def_property_readonly(
          "name", [](const LibraryMaterial& m) { return with_paths(m.name); }, "Name of the material.")
      .def_property_readonly(
          "file", [](const LibraryMaterial& m) { return with_paths(m.file.string()); }, "Its file.")
      .def_property_readonly(
          "note", [](const LibraryMaterial& m) { return with_paths(m.note); },
          "Purpose or limits in one line.")
      .def_readonly("group", &LibraryMaterial::group, "\"metals\", \"explosives\", \"polymers\", ...")
      .def("__repr__", [](const LibraryMaterial& m) {
        return with_paths(fmt::format("<{}: {}>", m.file.stem().string(), m.note));
      });
  module.def("materials", &library_materials, "List the materials of the library.");
  module.def(
      "samples",
      [](const std::filesystem::path& name, int count, std::uint64_t seed) {
        const auto drawn = [&] {
          const py::gil_scoped_release unlocked;
          return sample_material(name, count, seed);
        };
        const MaterialSamples samples = drawn();
        py::list materials;
        for (std::size_t i = 0; i < samples.materials.size(); ++i)
          materials.append(material_of_file(samples.materials[i], samples.changes[i]));
        return materials;
      },
      py::arg("name"), py::arg("count"), py::arg("seed") = 1,
      "Draw materials from the covariance of a fitted one, written by `whipple fit`.\n\n"
      "Raises InputError if the file has no covariance.");
  module.def(
      "material", &read, py::arg("name"), py::arg("changes") = std::map<std::string, std::string>(),
      "Read a material.\n\n"
      "name: of the library (\"copper\", or an entry of `materials`), or the path of a material file.\n"
      "changes: keys of the file with other values as in the file, {\"eos.gruneisen\": \"1.9\"}.\n"
      "Raises InputError with the file and line of each fault.");
}

}  // namespace
}  // namespace whipple::python

PYBIND11_MODULE(eos, module) {
  using namespace whipple::python;
  module.doc() =
      "Equations of state: materials, states, loci, mixtures and tables over numpy arrays. SI units.";
  add_errors(module);
  add_states(module);
  add_validity(module);
  py::class_<whipple::Material> material(
      module, "Material", "A material with its equation of state (SI units).", py::dynamic_attr());
  add_material(module, material);
  add_material_pickling(module, material);
  add_library(module);
  add_loci(module, material);
  add_explosives(module, material);
  pass_messages_to_python();
}
