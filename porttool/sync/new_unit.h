// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "porttool/sync/head_manner.h"
#include "porttool/sync/translator.h"

namespace porttool {

/// A unit that the source's edit brought, and what it is to be called in the port.
struct UnitToPort {
    const ScannedFile& file;
    const Unit& unit;
    std::string name;        ///< there
    bool on_device = false;  ///< the port runs what uses it on a device, and marks such functions
};

/// How the port writes what it is made of.
struct PortManners {
    const HeadManners& beside;   ///< of the same two files
    const HeadManners& project;  ///< of all pairs
    const EditTranslator& translator;
    const ScannedFile& target;  ///< the file that it comes into
};

/// The unit as the port has it, or why a person has to write it.
struct NewUnit {
    std::string text;  ///< its comment above it included; not indented
    std::string failure;
};
NewUnit port_new_unit(const UnitToPort& source, const PortManners& manners);

/// The names that a unit brings into the words of its text: parameters, locals, fields, enumerators, those of a
/// template.
std::set<std::string, std::less<>> names_within(const ScannedFile& file, const Unit& unit);

}  // namespace porttool
