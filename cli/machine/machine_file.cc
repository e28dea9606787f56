#include "cli/machine/machine_file.h"

#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "cli/study_setup/toml/toml_keys.h"
#include "data/files/atomic_file.h"
#include "data/input_error.h"
#include "data/text.h"
#include "models/model_file.h"

namespace errmap::machine {
namespace {

using data::QuotedName;
using models::Branch;
using models::ErrorDirection;
using models::ErrorSource;
using models::Joint;
using models::KinematicLink;
using models::MachineError;
using study_setup::Keys;
using study_setup::NumberOf;
using study_setup::ParseToml;
using study_setup::Place;
using study_setup::Refuse;

constexpr std::array kDirections = {ErrorDirection::kX,
                                    ErrorDirection::kY,
                                    ErrorDirection::kZ,
                                    ErrorDirection::kA,
                                    ErrorDirection::kB,
                                    ErrorDirection::kC};

// A link with what the chain does not ask for.
struct LinkInFile {
  KinematicLink link;
  std::string column;  // "" of a fixed link
  std::vector<MachineError> errors;
};

class MachineFileReader {
 public:
  MachineFileReader(const std::string& file, bool with_maps)
      : file_(file),
        folder_(std::filesystem::path(file).parent_path()),
        with_maps_(with_maps) {}

  MachineFile Read(const toml::table& root) {
    const Keys keys(root, "the machine", file_);
    keys.AllowOnly({"name", "length", "angle", "sensitive", "link"});
    std::string name = "machine";
    keys.TakeText("name", &name);
    length_ = ReadUnit(keys, "length", "mm", data::Quantity::kLength);
    angle_ = ReadUnit(keys, "angle", "rad", data::Quantity::kAngle);
    const std::array<bool, 3> sensitive = ReadSensitive(keys);
    std::vector<LinkInFile> links;
    for (const toml::table* table : keys.Tables("link")) {
      links.push_back(ReadLink(*table));
    }
    RequireTool(keys, links);
    // A machine of older versions has the same remark for each of its maps.
    if (remarks_.size() > 1) {
      remarks_.front() += fmt::format(
          "; the same holds for {} more of its maps", remarks_.size() - 1);
    }
    if (!remarks_.empty()) warnings_.push_back(remarks_.front());
    return {.machine = Assemble(std::move(name), sensitive, std::move(links)),
            .warnings = std::move(warnings_)};
  }

 private:
  static data::Unit ReadUnit(const Keys& keys,
                             const char* key,
                             std::string symbol,
                             data::Quantity quantity) {
    keys.TakeText(key, &symbol);
    data::Unit unit = data::UnitOfSymbol(symbol);
    if (unit.quantity == quantity) return unit;
    std::vector<std::string> known;
    for (const data::Unit& of : data::UnitsOf(quantity)) {
      known.push_back(of.symbol);
    }
    keys.RefuseType(key,
                    *keys.Find(key),
                    fmt::format("one of {}", data::JoinWords(known, ", ")));
  }

  static std::array<bool, 3> ReadSensitive(const Keys& keys) {
    std::vector<std::string> letters;
    keys.TakeList("sensitive", &letters, [](const std::string& letter) {
      if (letter != "X" && letter != "Y" && letter != "Z") {
        throw std::invalid_argument("'sensitive' lists X, Y or Z, found " +
                                    data::QuotedText(letter));
      }
    });
    if (letters.empty()) return {true, true, true};
    std::array<bool, 3> sensitive{};
    for (const std::string& letter : letters) {
      sensitive[static_cast<std::size_t>(letter.front() - 'X')] = true;
    }
    return sensitive;
  }

  LinkInFile ReadLink(const toml::table& table) {
    const Keys keys(table, "[[link]]", file_);
    keys.AllowOnly(
        {"name", "branch", "joint", "axis", "coordinate", "offset", "errors"});
    LinkInFile read;
    KinematicLink& link = read.link;
    keys.TakeText("name", &link.name);
    if (link.name.empty()) keys.RefuseTable("needs name = \"...\"");
    if (!names_.insert(link.name).second) {
      Refuse(file_,
             keys.Find("name")->source(),
             fmt::format("two links are named {}; a chain goes from the base "
                         "outwards and has no loops",
                         QuotedName(link.name)));
    }
    const Keys of_link(table, "link " + QuotedName(link.name), file_);
    link.branch = OneOf<Branch>(
        of_link, "branch", {{"tool", Branch::kTool}, {"work", Branch::kWork}});
    link.joint = OneOf<Joint>(of_link,
                              "joint",
                              {{"linear", Joint::kLinear},
                               {"rotary", Joint::kRotary},
                               {"fixed", Joint::kFixed}});
    link.offset = ReadVector(of_link, "offset");
    WarnOfOffset(of_link, link);
    ReadMotion(of_link, &read);
    ReadErrors(of_link, &read);
    return read;
  }

  // Of a key that must be there.
  template <typename T>
  T OneOf(const Keys& keys,
          const char* key,
          const std::map<std::string, T>& words) const {
    std::string word;
    keys.TakeText(key, &word);
    if (const auto found = words.find(word); found != words.end()) {
      return found->second;
    }
    std::vector<std::string> known;
    for (const auto& [name, value] : words) known.push_back('"' + name + '"');
    const std::string wanted = data::JoinWords(known, " or ");
    if (keys.Find(key) == nullptr) {
      keys.RefuseTable(fmt::format("needs {} = {}", key, wanted));
    }
    keys.RefuseType(key, *keys.Find(key), wanted);
  }

  // 0 where the key is absent.
  static Eigen::Vector3d ReadVector(const Keys& keys, const char* key) {
    constexpr const char* kWanted = "three finite numbers such as [0, 0, 1]";
    Eigen::Vector3d vector = Eigen::Vector3d::Zero();
    const toml::node* const node = keys.Find(key);
    if (node == nullptr) return vector;
    const toml::array* const array = node->as_array();
    if (array == nullptr || array->size() != 3) {
      keys.RefuseType(key, *node, kWanted);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const toml::node& item = *array->get(i);
      if (!item.is_number() || !std::isfinite(NumberOf(item))) {
        keys.RefuseType(key, item, kWanted);
      }
      vector[static_cast<Index>(i)] = NumberOf(item);
    }
    return vector;
  }

  static void ReadMotion(const Keys& keys, LinkInFile* read) {
    keys.TakeText("coordinate", &read->column);
    read->link.axis = ReadVector(keys, "axis");
    if (read->link.joint == Joint::kFixed) {
      if (keys.Find("axis") != nullptr || !read->column.empty()) {
        keys.RefuseTable(
            "is fixed: 'axis' and 'coordinate' go with joint = "
            "\"linear\" or \"rotary\"");
      }
      return;
    }
    if (read->link.axis.norm() == 0.0) {
      keys.RefuseTable("moves and needs an axis such as [0, 0, 1]");
    }
    if (read->column.empty()) {
      keys.RefuseTable("moves and needs coordinate = \"COLUMN\" of the points");
    }
  }

  void ReadErrors(const Keys& keys, LinkInFile* read) {
    const toml::node* const node = keys.Find("errors");
    if (node == nullptr) return;
    const toml::table* const table = node->as_table();
    if (table == nullptr) {
      keys.RefuseType("errors",
                      *node,
                      "a table such as { EXX = \"model.json\", EBX = 0.0 }");
    }
    const KinematicLink& link = read->link;
    const auto name_of = [&](ErrorDirection direction) {
      return fmt::format("E{}{}", models::LetterOf(direction), link.name);
    };
    std::vector<std::string> names;
    for (const ErrorDirection direction : kDirections) {
      names.push_back(name_of(direction));
    }
    // The letters end with the link's name: an error of X does not slip into Z.
    const Keys errors(*table, "errors of link " + QuotedName(link.name), file_);
    errors.AllowOnly(names);
    for (const ErrorDirection direction : kDirections) {
      const toml::node* const value = errors.Find(name_of(direction));
      if (value == nullptr) continue;
      read->link.errors.push_back(direction);
      read->errors.push_back(
          {.name = name_of(direction),
           .sources = ReadSources(
               errors, name_of(direction), *value, direction, link)});
    }
  }

  std::vector<ErrorSource> ReadSources(const Keys& errors,
                                       const std::string& name,
                                       const toml::node& value,
                                       ErrorDirection direction,
                                       const KinematicLink& link) {
    const toml::table* const pair = value.as_table();
    if (pair == nullptr) return {ReadSource(errors, name, value, direction)};
    const Keys directions(*pair, QuotedName(name), file_);
    directions.AllowOnly({"forward", "reverse"});
    if (link.joint == Joint::kFixed) {
      Refuse(file_,
             value.source(),
             fmt::format("{}: link {} is fixed and has no direction of motion; "
                         "give one map or constant",
                         name,
                         QuotedName(link.name)));
    }
    std::vector<ErrorSource> sources;
    for (const char* way : {"forward", "reverse"}) {
      const toml::node* const node = directions.Find(way);
      if (node == nullptr) {
        directions.RefuseTable(fmt::format("needs '{}', too", way));
      }
      sources.push_back(ReadSource(directions, way, *node, direction));
    }
    return sources;
  }

  ErrorSource ReadSource(const Keys& keys,
                         const std::string& key,
                         const toml::node& node,
                         ErrorDirection direction) {
    const data::Unit& unit = IsRotation(direction) ? angle_ : length_;
    ErrorSource source;
    if (node.is_number() && std::isfinite(NumberOf(node))) {
      source.constant = NumberOf(node);
      if (IsRotation(direction)) {
        source.constant =
            data::Converted(source.constant, unit, data::UnitOfSymbol("rad"));
      }
      WarnOfSize(key, node, source.constant, direction);
      return source;
    }
    const auto* const text = node.as_string();
    if (text == nullptr || text->get().empty()) {
      keys.RefuseType(
          key,
          node,
          fmt::format("a model file, a number of {}, or {{ forward = ..., "
                      "reverse = ... }}",
                      unit.symbol));
    }
    source.file = text->get();
    if (!with_maps_) return source;
    if (!folder_.empty()) {
      source.file = (folder_ / text->get()).lexically_normal().string();
    }
    source.map = LoadMap(key, source.file, node, direction);
    return source;
  }

  // Between the links of a machine tool are millimetres to metres.
  void WarnOfOffset(const Keys& keys, const KinematicLink& link) {
    constexpr double kLeastMm = 1.0;
    constexpr double kMostMm = 5e4;
    const double size = link.offset.norm();
    const double size_mm =
        data::Converted(size, length_, data::UnitOfSymbol("mm"));
    if (size == 0.0 || (size_mm >= kLeastMm && size_mm <= kMostMm)) return;
    warnings_.push_back(fmt::format(
        "{}warning: link {} is {} {} away from the one before; the file's "
        "lengths are in {}",
        Place(file_, keys.Find("offset")->source()),
        QuotedName(link.name),
        size,
        length_.symbol,
        length_.symbol));
  }

  // Errors of a machine tool are small; those in a wrong unit are not.
  void WarnOfSize(const std::string& name,
                  const toml::node& node,
                  double value,
                  ErrorDirection direction) {
    constexpr double kMostMm = 1.0;
    constexpr double kMostRad = 0.01;
    const bool is_angle = IsRotation(direction);
    const double size =
        is_angle ? value
                 : data::Converted(value, length_, data::UnitOfSymbol("mm"));
    if (std::abs(size) <= (is_angle ? kMostRad : kMostMm)) return;
    warnings_.push_back(fmt::format(
        "{}warning: {} = {} {} is not an error of a machine tool; the "
        "file's {} are in {}",
        Place(file_, node.source()),
        name,
        NumberOf(node),
        is_angle ? angle_.symbol : length_.symbol,
        is_angle ? "angles" : "lengths",
        is_angle ? angle_.symbol : length_.symbol));
  }

  std::shared_ptr<const models::FittedModel> LoadMap(const std::string& name,
                                                     const std::string& path,
                                                     const toml::node& node,
                                                     ErrorDirection direction) {
    // A map of several errors is read once.
    std::shared_ptr<const models::FittedModel>& map = maps_[path];
    if (map == nullptr) {
      try {
        map = std::make_shared<const models::FittedModel>(
            models::LoadModel(path));
        remarks_.insert(
            remarks_.end(), map->remarks.begin(), map->remarks.end());
      } catch (const data::InputError& error) {
        Refuse(file_, node.source(), fmt::format("{}: {}", name, error.what()));
      }
    }
    const bool is_angle = IsRotation(direction);
    const data::Unit unit = map->target.unit;
    if (unit.quantity !=
        (is_angle ? data::Quantity::kAngle : data::Quantity::kLength)) {
      Refuse(file_,
             node.source(),
             fmt::format("{} is {}, and {} predicts {} in {}; an error in "
                         "another quantity has its unit in the target's name",
                         name,
                         is_angle ? "an angle" : "a length",
                         data::PrintablePath(path),
                         QuotedName(map->target.name),
                         unit.symbol.empty() ? "no unit" : unit.symbol));
    }
    if (map->align == data::Alignment::kFirst) {
      warnings_.push_back(fmt::format(
          "{}warning: {} predicts since its session's first row, and so counts "
          "in the error at the tool",
          Place(file_, node.source()),
          data::PrintablePath(path)));
    }
    return map;
  }

  void RequireTool(const Keys& keys,
                   const std::vector<LinkInFile>& links) const {
    for (const LinkInFile& link : links) {
      if (link.link.branch == Branch::kTool) return;
    }
    keys.RefuseTable("needs a [[link]] with branch = \"tool\"");
  }

  models::Machine Assemble(std::string name,
                           const std::array<bool, 3>& sensitive,
                           std::vector<LinkInFile> links) const {
    std::vector<KinematicLink> chain;
    std::vector<std::string> columns;
    std::vector<MachineError> errors;
    for (LinkInFile& link : links) {
      if (!link.column.empty()) columns.push_back(link.column);
      for (MachineError& error : link.errors) errors.push_back(error);
      chain.push_back(std::move(link.link));
    }
    return {.name = std::move(name),
            .length = length_,
            .chain = models::KinematicChain(std::move(chain)),
            .columns = std::move(columns),
            .errors = std::move(errors),
            .sensitive = sensitive};
  }

  const std::string& file_;
  std::filesystem::path folder_;
  bool with_maps_;
  data::Unit length_;
  data::Unit angle_;
  std::set<std::string> names_;
  std::map<std::string, std::shared_ptr<const models::FittedModel>> maps_;
  std::vector<std::string> warnings_;
  std::vector<std::string> remarks_;  // of the maps
};

MachineFile ReadMachine(const std::string& path, bool with_maps) {
  const std::string text = data::ReadFile(path, data::kMostTextOfPeople);
  if (text.starts_with('{')) {
    throw data::InputError(
        data::PrintablePath(path) +
        ": is JSON, and a machine is a TOML file that names a map for each of "
        "its errors; errmap simulate turning-centre writes one");
  }
  const toml::table root = ParseToml(text, path);
  return MachineFileReader(path, with_maps).Read(root);
}

}  // namespace

MachineFile ReadMachineFile(const std::string& path) {
  return ReadMachine(path, true);
}

MachineFile ReadMachineOutline(const std::string& path) {
  return ReadMachine(path, false);
}

}  // namespace errmap::machine
