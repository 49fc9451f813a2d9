// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors
//
// ridgeway_fuzz --list
//     names the readers
// ridgeway_fuzz --unpack FILE.ridge OUT
//     turns a .ridge file into a sample for the readers ridge and tsdf
// RIDGEWAY_FUZZ_READER=NAME ridgeway_fuzz [what libFuzzer knows] [CORPUS...]
//     feeds one of them
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "files/read_file.hpp"
#include "readers.hpp"
#include "ridgeway/common/error.hpp"
#include "unpacked_ridge.hpp"

namespace {

using ridgeway::fuzz::Reader;

const Reader* chosen = nullptr;

void list() {
  for (const Reader& reader : ridgeway::fuzz::all_readers())
    std::printf("%.*s\n", static_cast<int>(reader.name.size()), reader.name.data());
}

void unpack(const char* from, const char* to) {
  const std::string bytes = ridgeway::fuzz::unpack_ridge(from);
  std::ofstream(to, std::ios::binary) << bytes;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string first = *argc > 1 ? (*argv)[1] : "";
  if (first == "--list") {
    list();
    std::exit(EXIT_SUCCESS);
  }
  if (first == "--unpack" && *argc == 4) {
    unpack((*argv)[2], (*argv)[3]);
    std::exit(EXIT_SUCCESS);
  }
  const char* const name = std::getenv("RIDGEWAY_FUZZ_READER");
  for (const Reader& reader : ridgeway::fuzz::all_readers())
    if (name != nullptr && reader.name == name) chosen = &reader;
  if (chosen == nullptr) {
    std::fputs("RIDGEWAY_FUZZ_READER names no reader; ridgeway_fuzz --list does\n", stderr);
    std::exit(EXIT_FAILURE);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    chosen->read({reinterpret_cast<const char*>(data), size});
  } catch (const ridgeway::InputError& error) {
    if (error.where().empty() || error.problem().empty() || error.remedy().empty()) std::abort();
  }
  return 0;
}
