// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

// `pathtracer-import` turns what others' libraries read (OBJ, FBX, Draco) into what the loader reads and checks itself.
// It is a program of its own, so that no such library, however it takes a hostile file, can harm the one that renders:
// memory and time are limited, and a crash is a message. What it writes is checked like any file.

namespace importer {

/// Why a file cannot be imported: what is wrong and, after a semicolon, what to do. Thrown; main prints it.
struct ImportError {
    std::string message;
};

/// A Wavefront OBJ with its MTL files, as a .glb on stdout. With `anywhere` the MTL files may lie outside its folder.
void import_obj(const std::filesystem::path& path, bool anywhere);

/// An FBX file, binary or text, as a .glb on stdout.
void import_fbx(const std::filesystem::path& path);

/// Draco streams from stdin (each 8 bytes of length, then that many), decoded to stdout as draco_exchange.h says.
void decode_draco_streams();

/// Writes all of it to stdout, or throws.
void write_out(const void* data, size_t size);

}  // namespace importer
