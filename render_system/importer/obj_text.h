// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace importer {

class GlbBuilder;

// Texts of OBJ and MTL before tinyobjloader reads them. It takes what it does not understand for 0, and says nothing.

/// The text with each line that goes on behind a backslash made one, with as many line breaks as before; empty if there
/// is no such line.
std::string joined_lines(std::string_view text);

/// The text without the slashes that stand at the end of a face's corners (`1//`, `2/2/`), which tinyobjloader takes
/// for an index of 0; as many characters as before, empty if there is none.
std::string closed_corners(std::string_view text);

/// Throws ImportError, with the line, where a position has no numbers, an index is past 32 bits or a face has more
/// corners than are cut into triangles in bearable time. Faces of one or two corners, and normals and texture
/// coordinates that are no numbers, are named as left out. Answers the materials that faces ask for, with the line of
/// the first `usemtl`.
std::map<std::string, size_t> check_obj(std::string_view text, GlbBuilder& builder);

/// The text of an MTL file called `name`, in which each colour has three numbers. What is no number, and colours given
/// as spectra or by CIE XYZ, are taken out and named as left out, with file and line.
std::string plain_mtl(std::string_view text, const std::string& name, GlbBuilder& builder);

}  // namespace importer
