// SPDX-License-Identifier: BSD-3-Clause
#include "python/eos/pickling.hpp"

#include <algorithm>
#include <filesystem>
#include <map>

#include "src/material/material_file.hpp"
#include "src/material/material_samples.hpp"

namespace whipple::python {
namespace {

constexpr const char* recipe = "_recipe";

py::object copied(const py::object& self) {
  py::object copy = py::cast(Material(self.cast<const Material&>()));
  if (py::hasattr(self, recipe)) py::setattr(copy, recipe, py::getattr(self, recipe));
  return copy;
}

/// Rereads a material of a pickle.
py::object restored_material(const std::filesystem::path& file,
                             const std::map<std::string, std::string>& changes,
                             const std::string& constants) {
  const std::vector<std::pair<std::string, std::string>> list(changes.begin(), changes.end());
  Material material = read_changed_material(file, list);
  if (material.constants() != constants) {
    throw InputError(
        fmt::format("{}: has changed since the material was pickled: read it again", file.string()));
  }
  return material_of_file(std::move(material), list);
}

}  // namespace

py::str with_paths(const std::string& text) {
  PyObject* decoded =
      PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape");
  if (decoded == nullptr) throw py::error_already_set();
  return py::reinterpret_steal<py::str>(decoded);
}

py::object with_recipe(Material material, const py::object& function, const py::tuple& arguments) {
  py::object object = py::cast(std::move(material));
  py::setattr(object, recipe, py::make_tuple(function, arguments));
  return object;
}

py::object material_of_file(Material material,
                            const std::vector<std::pair<std::string, std::string>>& changes) {
  py::dict keys;
  for (const auto& [key, value] : changes) keys[py::str(key)] = value;
  const std::filesystem::path file = std::filesystem::absolute(material.file);
  const py::bytes constants(material.constants());  // one of their comments contains the path
  // Use a Python function: those of extension modules cannot be pickled.
  const py::object function = py::module_::import("whipple").attr("_restored_material");
  return with_recipe(std::move(material), function, py::make_tuple(file, keys, constants));
}

void add_material_pickling(py::module_& module, py::class_<Material>& material) {
  module.def("_restored_material", &restored_material);
  material.def("__copy__", &copied)
      .def("__deepcopy__", [](const py::object& self, const py::dict&) { return copied(self); })
      .def("__reduce__", [](const py::object& self) -> py::object {
        if (!py::hasattr(self, recipe)) {
          throw py::type_error("this material belongs to a result: pickle the one that material() has read");
        }
        return py::getattr(self, recipe);
      });
}

py::tuple packed(const States& s, std::span<double eos::State::* const> quantities) {
  py::list columns, phases, further;
  for (double eos::State::* const member : quantities) {
    Numbers column(static_cast<py::ssize_t>(s.states.size()));
    for (std::size_t i = 0; i < s.states.size(); ++i) column.mutable_data()[i] = s.states[i].*member;
    columns.append(column);
  }
  for (const eos::State& state : s.states) phases.append(py::str(std::string(state.phase)));
  for (const std::vector<double>& column : s.further)
    further.append(Numbers(static_cast<py::ssize_t>(column.size()), column.data()));
  return py::make_tuple(py::tuple(py::cast(s.shape)), columns, phases, further, s.model());
}

void unpack(States& s, const py::tuple& pack, std::span<double eos::State::* const> quantities) {
  if (pack.size() != 5) throw InputError("a pickle of states of another version");
  s.shape = pack[0].cast<Shape>();
  const auto columns = pack[1].cast<std::vector<Numbers>>();
  const auto phases = pack[2].cast<std::vector<std::string>>();
  const bool same =
      columns.size() == quantities.size() && std::ranges::all_of(columns, [&](const Numbers& column) {
        return column.size() == static_cast<py::ssize_t>(phases.size());
      });
  if (!same) throw InputError("a pickle of states of another version");
  auto names = std::make_shared<RestoredNames>();
  names->model = pack[4].cast<std::string>();
  s.states.resize(phases.size());
  for (std::size_t i = 0; i < phases.size(); ++i) {
    for (std::size_t k = 0; k < quantities.size(); ++k) s.states[i].*quantities[k] = columns[k].data()[i];
    s.states[i].phase = *names->phases.insert(phases[i]).first;
  }
  for (const Numbers& column : pack[3].cast<std::vector<Numbers>>())
    s.further.emplace_back(column.data(), column.data() + column.size());
  s.restored = std::move(names);
}

}  // namespace whipple::python
