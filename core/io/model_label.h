// What is told of a model beside its shape.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace gyre {

// As the user typed them; what is empty is not written.
struct ModelLabel {
  std::string title;
  std::string inventory_number;
  std::string rights;  // who may do what with the model
};

// The label of the scan to which a folder, its .gyre file or a file in it belongs. Empty where
// there is no scan: a model needs no label.
ModelLabel labelOfScan(const std::filesystem::path& path);

// The same as XML and JSON can hold it: valid UTF-8, without control characters.
ModelLabel writableLabel(const ModelLabel& label);

}  // namespace gyre
