#pragma once

namespace errmap::fleet {

/// SQL that brings a store from each version to the next, from 0: nothing.
/// Lengths are in the data file's own unit, times in seconds.
extern const char* const kStoreMigrations[];

}  // namespace errmap::fleet
