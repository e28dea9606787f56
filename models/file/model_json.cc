#include "models/file/model_json.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include <fmt/format.h>

#include "data/input_error.h"

namespace errmap::models {

using Node = ModelJsonNode;

namespace {

// "'a', 'b' or 'c'"
std::string EitherOf(const std::vector<std::string>& words) {
  std::string list;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) list += i + 1 < words.size() ? ", " : " or ";
    list += "'" + words[i] + "'";
  }
  return list;
}

}  // namespace

ModelJsonNode::ModelJsonNode(const ModelJson& value,
                             std::string path,
                             const std::string& source)
    : value_(value), path_(std::move(path)), source_(source) {}

void Node::Refuse(const std::string& why) const {
  throw data::InputError(
      fmt::format("{}: {}{}; fit the model again or restore the file",
                  source_,
                  path_.empty() ? "" : "key '" + path_ + "': ",
                  why));
}

void Node::RefuseWord(const std::vector<std::string>& words,
                      const std::string& found) const {
  Refuse(fmt::format("must be {}, found '{}'", EitherOf(words), found));
}

void Node::RefuseWithout(const std::vector<std::string>& keys) const {
  Refuse("has no key " + EitherOf(keys));
}

Node Node::At(const std::string& key) const {
  if (!value_.is_object()) Refuse("must be an object");
  const auto found = value_.find(key);
  if (found == value_.end()) Refuse("has no key '" + key + "'");
  return {*found, path_.empty() ? key : path_ + "." + key, source_};
}

std::optional<Node> Node::Find(const std::string& key) const {
  if (!value_.is_object()) Refuse("must be an object");
  const auto found = value_.find(key);
  if (found == value_.end() || found->is_null()) return std::nullopt;
  return At(key);
}

std::vector<Node> Node::Elements() const {
  if (!value_.is_array()) Refuse("must be an array");
  std::vector<Node> elements;
  for (std::size_t i = 0; i < value_.size(); ++i) {
    elements.emplace_back(value_[i], fmt::format("{}[{}]", path_, i), source_);
  }
  return elements;
}

std::string Node::Text() const {
  if (!value_.is_string()) Refuse("must be text");
  return value_.get<std::string>();
}

double Node::Number() const {
  if (!value_.is_number()) Refuse("must be a finite number");
  const double number = value_.get<double>();
  if (!std::isfinite(number)) Refuse("must be a finite number");
  return number;
}

bool Node::Truth() const {
  if (!value_.is_boolean()) Refuse("must be true or false");
  return value_.get<bool>();
}

Index Node::Count() const {
  if (!value_.is_number_integer() || value_.get<std::int64_t>() < 0) {
    Refuse("must be a whole number of at least 0");
  }
  return value_.get<Index>();
}

VectorXd Node::Vector() const {
  const std::vector<Node> elements = Elements();
  VectorXd vector(std::ssize(elements));
  for (std::size_t i = 0; i < elements.size(); ++i) {
    vector[static_cast<Index>(i)] = elements[i].Number();
  }
  return vector;
}

MatrixXd Node::Matrix() const {
  const std::vector<Node> rows = Elements();
  if (rows.empty()) return {};
  MatrixXd matrix;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const VectorXd row = rows[i].Vector();
    if (i == 0) matrix.resize(std::ssize(rows), row.size());
    if (row.size() != matrix.cols()) {
      rows[i].Refuse(fmt::format(
          "has {} numbers, the first row has {}", row.size(), matrix.cols()));
    }
    matrix.row(static_cast<Index>(i)) = row.transpose();
  }
  return matrix;
}

}  // namespace errmap::models
