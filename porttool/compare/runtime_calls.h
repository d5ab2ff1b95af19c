// SPDX-FileCopyrightText: 2026 The porttool authors
// SPDX-License-Identifier: Apache-2.0
// What runtimes of one source have as functions and others as methods of an object that is handed on.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "porttool/normal/normal_text.h"

namespace porttool {

/// The names that a text declares for what work is given to and what tells a thread its place: SYCL's queue, handler
/// and nd_item, a stream. They hold no data.
using ContextNames = std::set<std::string_view>;
void note_contexts(const Words& text, ContextNames& names);

/// Takes these out of the parameters and arguments of a statement. A program that must hand them on computes the same
/// as one that finds them everywhere.
///
///     void f ( float * x , sycl :: nd_item < 1 > & item )      void f ( float * x )
///     f ( x , item )                                           f ( x )
void drop_contexts(Words& statement, const ContextNames& names);

/// `cudaMalloc`, `hipFree`, `clFinish`: functions of runtimes that give back a status. A Meaning has them in small
/// letters.
bool is_runtime_call(std::string_view name);

/// `HIP_CHECK`, `checkCudaErrors`, `CUDA_SAFE_CALL`: looks at such a status, as its name says.
bool says_that_it_checks(std::string_view name);

/// True for the `< < <` of a launch at that place.
bool opens_launch(const Words& text, size_t i);

/// True for a text of the host: it calls a runtime, launches a kernel or hands one to a queue.
bool drives_device(const Words& text);

/// True if an edit put one direction of copying (`cudaMemcpyHostToDevice`) in the place of another.
bool changes_direction(const Words& before, const Words& now);

/// How calls of a runtime are read.
struct TransferRules {
    bool of_queue = false;  ///< the statement begins with a queue
    bool in_order = false;  ///< queues keep the order of what they are given
    bool directed = false;  ///< the direction of a copy counts, which SYCL does not say
};

/// Writes the calls that fill, copy and free memory of a device, and that wait for it, in one way. Words are common
/// ones; only where it is the whole statement. What is waited for is not the same as what is not, but for a stretch
/// that is filled through a queue that keeps the order.
///
///     cudaMemset ( p , 0 , n )                             q . memset ( p , 0 , n )
///     cudaMemcpy ( a , b , n , cudaMemcpyHostToDevice )    q . memcpy ( a , b , n ) . wait ( )
///     cudaDeviceSynchronize ( )                            q . wait ( )
void write_plain_transfer(std::vector<std::string>& words, const TransferRules& rules);

}  // namespace porttool
