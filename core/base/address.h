// Addresses of cameras on the network, as they may be shown and stored.
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace gyre {

// The address with "***" in place of its password, of a user name that stands alone, and of the
// values of query fields that name one. Anything that is no address comes back as it is.
std::string withoutPassword(const std::string& address);

// Whether the address is one whose password was left out by withoutPassword().
bool lacksPassword(const std::string& address);

}  // namespace gyre
