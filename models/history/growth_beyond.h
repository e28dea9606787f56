#pragma once

#include <string>
#include <vector>

#include "data/measurements/dataset.h"
#include "models/error_model.h"

namespace errmap::models {

/// For how many trained ranges (0 to 3) a straight line in what only grows is
/// to be believed beyond the last of `training`. 3 where nothing grows, or
/// where F tests (beside a plane of the other inputs) see a slope and neither a
/// bend nor sessions that lie about the line; 0 where they see no slope. Else
/// by what sessions showed of it that came later than others: planes of the
/// first two sessions, of the first three and so on foretell the rest, and stop
/// after so many ranges; the longest of those that err least. `shared` (may be
/// null) has it of the same rows once.
double RoomBeyond(const data::Dataset& training, SharedWork* shared = nullptr);

/// How an error goes on in what only grows.
enum class Growth {
  kStraight,    // in a line
  kWithOthers,  // in a line whose slope follows the other inputs
  kBending,     // in a parabola besides
};

/// What the sessions of `training` prove of that: more than a line only where a
/// plane with such bends, learnt from the first two fifths of the sessions,
/// foretells all that came later with at most 0.9 of the error of a plane with
/// fewer, and so again each time that further sessions are known, four times at
/// least (at most twelve are tried). `shared` as in RoomBeyond.
Growth GrowthBeyond(const data::Dataset& training,
                    SharedWork* shared = nullptr);

/// Guards of a map that goes on in the inputs named, which only grow and so
/// will leave their range: `room` ranges more for them, and for the
/// error.
void LeaveRoom(const std::vector<std::string>& growing,
               double room,
               const std::vector<TrainedInput>& form_inputs,
               Guards* guards);

}  // namespace errmap::models
