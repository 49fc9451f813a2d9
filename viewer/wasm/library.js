// SPDX-License-Identifier: BSD-3-Clause
// Copyright (c) 2026 The Ridgeway authors

// What the planner asks of JavaScript.
mergeInto(LibraryManager.library, {
  // Unpacks what zstd packed; 0xffffffff where it cannot be, or does not fit.
  ridgeway_unpack: function (to, room, from, bytes) {
    try {
      const unpacked = Module["unpack"](HEAPU8.slice(from, from + bytes));
      if (unpacked.length > room) return -1;
      HEAPU8.set(unpacked, to);
      return unpacked.length;
    } catch (error) {
      return -1;
    }
  },
});
