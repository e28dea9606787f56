#include "cli/netcg/netcg_files.h"
#include "data/csv.h"
#include "data/formats/fortran_format.h"
#include "data/formats/record_reader.h"
#include "data/text.h"

namespace errmap::netcg {
namespace {

using data::EditE;
using data::EditI;
constexpr const char* kScalingWord = "scaling";

// The offset of a layer in w, its nodes and what leads to each of them.
struct Layer {
  Index offset;
  Index nodes;
  Index sources;
  const char* into;
};

std::array<Layer, 2> LayersOf(const NetcgWeights& weights) {
  const Index first = weights.hidden * (weights.inputs + 1);
  return {{{0, weights.hidden, weights.inputs + 1, "hidden node "},
           {first, weights.outputs, weights.hidden + 1, "output node "}}};
}

Index NumWeights(const NetcgWeights& weights) {
  return weights.hidden * (weights.inputs + 1) +
         weights.outputs * (weights.hidden + 1);
}

}  // namespace

NetcgWeights ParseWeights(std::string_view text, const std::string& name) {
  data::RecordReader reader(text, name);
  const std::string what = "numbers of inputs, hidden nodes and outputs";
  const std::vector<long long> nodes = reader.Integers(3, what);
  constexpr long long kMost = 1'000'000;
  for (const long long count : nodes) {
    if (count < 1 || count > kMost) {
      reader.Refuse("expected " + what + ", each 1 to " +
                    std::to_string(kMost) + "; found " + std::to_string(count));
    }
  }
  NetcgWeights weights{
      .inputs = nodes[0], .hidden = nodes[1], .outputs = nodes[2]};
  // A number and a blank at least: no memory for what cannot be there.
  constexpr Index kLeastCharacters = 2;
  if (NumWeights(weights) * kLeastCharacters > std::ssize(text)) {
    reader.Refuse("a net of " + std::to_string(nodes[0]) + "-" +
                  std::to_string(nodes[1]) + "-" + std::to_string(nodes[2]) +
                  " nodes has " + std::to_string(NumWeights(weights)) +
                  " weights, more than this file can hold");
  }
  weights.w.resize(NumWeights(weights));
  for (const Layer& layer : LayersOf(weights)) {
    for (Index node = 0; node < layer.nodes; ++node) {
      const std::vector<double> row =
          reader.Numbers(static_cast<std::size_t>(layer.sources),
                         std::to_string(layer.sources) + " weights into " +
                             layer.into + std::to_string(node + 1));
      for (Index from = 0; from < layer.sources; ++from) {
        weights.w[layer.offset + from * layer.nodes + node] =
            row[static_cast<std::size_t>(from)];
      }
    }
  }
  if (reader.AtEnd()) return weights;
  const std::vector<std::string> last =
      reader.Words(3, "the end of the file, or \"scaling\" and two numbers");
  models::TargetScaling scaling;
  if (last[0] != kScalingWord || !data::ParseNumber(last[1], &scaling.slope) ||
      !data::ParseNumber(last[2], &scaling.offset) || !reader.AtEnd()) {
    reader.Refuse("expected the end of the file after " +
                  std::to_string(weights.w.size()) + " weights, found more");
  }
  weights.scaling = scaling;
  return weights;
}

std::string WeightsText(const NetcgWeights& weights, WeightDigits digits) {
  constexpr int kNodesWidth = 5;
  constexpr Index kPerLine = 5;
  constexpr int kWidth = 14;
  constexpr int kDigits = 6;
  std::string text = EditI(weights.inputs, kNodesWidth) +
                     EditI(weights.hidden, kNodesWidth) +
                     EditI(weights.outputs, kNodesWidth) + "\n";
  for (const Layer& layer : LayersOf(weights)) {
    for (Index node = 0; node < layer.nodes; ++node) {
      for (Index from = 0; from < layer.sources; ++from) {
        const double value =
            weights.w[layer.offset + from * layer.nodes + node];
        if (from % kPerLine == 0) text += ' ';
        text += digits == WeightDigits::kReport ? EditE(value, kWidth, kDigits)
                                                : " " + data::CsvNumber(value);
        const bool ends =
            from % kPerLine == kPerLine - 1 || from + 1 == layer.sources;
        if (ends) text += '\n';
      }
    }
  }
  if (digits == WeightDigits::kFull && weights.scaling) {
    text += std::string(kScalingWord) + " " +
            data::CsvNumber(weights.scaling->slope) + " " +
            data::CsvNumber(weights.scaling->offset) + "\n";
  }
  return text;
}

namespace {

constexpr int kGraphInteger = 6;
constexpr int kGraphReal = 15;
constexpr int kGraphDigits = 6;

std::string GraphSize(Index rows, Index columns) {
  return EditI(rows, kGraphInteger) + " " + EditI(columns, kGraphInteger) +
         "\n";
}

}  // namespace

std::string FirstLayerGraph(const NetcgWeights& weights) {
  std::string text = GraphSize(weights.inputs + 2, weights.hidden + 1) +
                     EditI(0, kGraphInteger);
  for (Index h = 1; h <= weights.hidden; ++h) text += EditI(h, kGraphReal);
  text += '\n';
  for (Index i = 0; i <= weights.inputs; ++i) {
    text += EditI(i + 1, kGraphInteger);
    for (Index h = 0; h < weights.hidden; ++h) {
      text +=
          EditE(weights.w[i * weights.hidden + h], kGraphReal, kGraphDigits);
    }
    text += '\n';
  }
  return text;
}

std::string SecondLayerGraph(const NetcgWeights& weights) {
  std::string text = GraphSize(weights.hidden + 1, weights.outputs + 1);
  const Index first = weights.hidden * (weights.inputs + 1);
  for (Index h = 0; h <= weights.hidden; ++h) {
    text +=
        EditI(h + 1, kGraphInteger) +
        EditE(
            weights.w[first + h * weights.outputs], kGraphReal, kGraphDigits) +
        "\n";
  }
  return text;
}

}  // namespace errmap::netcg
