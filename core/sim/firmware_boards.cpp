// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/sim/firmware_boards.h"

#include <utility>

#include "core/sim/artivact_board.h"
#include "core/sim/comxim_board.h"
#include "core/sim/fabscan_board.h"
#include "core/sim/grbl_board.h"
#include "core/sim/horus_board.h"
#include "core/sim/marlin_board.h"
#include "core/sim/sardauscan_board.h"
#include "core/sim/workshop_board.h"

namespace gyre {

std::vector<std::string> firmwareBoardNames() {
  return {"grbl", "marlin", "horus", "fabscan", "sardauscan", "artivact", "comxim", "workshop"};
}

std::unique_ptr<FirmwareBoard> makeFirmwareBoard(const std::string& name,
                                                 const TurntableFirmwareOptions& options,
                                                 std::shared_ptr<Shaft> shaft) {
  if (name == "grbl") return std::make_unique<GrblBoard>(options, std::move(shaft));
  if (name == "marlin") return std::make_unique<MarlinBoard>(options, std::move(shaft));
  if (name == "horus") return std::make_unique<HorusBoard>(options, std::move(shaft));
  if (name == "fabscan") return std::make_unique<FabScanBoard>(options, std::move(shaft));
  if (name == "sardauscan") return std::make_unique<SardauscanBoard>(options, std::move(shaft));
  if (name == "artivact") return std::make_unique<ArtivactBoard>(options, std::move(shaft));
  if (name == "comxim") return std::make_unique<ComXimBoard>(options, std::move(shaft));
  if (name == "workshop") return std::make_unique<WorkshopBoard>(options, std::move(shaft));
  return nullptr;
}

}  // namespace gyre
