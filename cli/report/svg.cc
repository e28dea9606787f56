#include "cli/report/svg.h"

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <map>
#include <vector>

#include <fmt/format.h>

namespace errmap::cli {
namespace {

using Attributes = std::map<std::string, std::string, std::less<>>;

bool IsBlank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

// A number to a tenth of a pixel: "72.5", "-3".
std::string Tenth(double value) {
  std::string text = fmt::format("{:.1f}", value);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

struct Tag {
  std::string name;
  Attributes attributes;
  bool closes = false;  // </name>
  bool alone = false;   // <name/>
};

// Reads what stands between '<' and '>'.
Tag ParseTag(std::string_view text) {
  Tag tag;
  if (text.starts_with('/')) {
    tag.closes = true;
    text.remove_prefix(1);
  }
  if (text.ends_with('/')) {
    tag.alone = true;
    text.remove_suffix(1);
  }
  std::size_t i = 0;
  while (i < text.size() && !IsBlank(text[i])) tag.name += text[i++];
  while (i < text.size()) {
    while (i < text.size() && IsBlank(text[i])) ++i;
    std::string name;
    while (i < text.size() && text[i] != '=' && !IsBlank(text[i])) {
      name += text[i++];
    }
    while (i < text.size() && (IsBlank(text[i]) || text[i] == '=')) ++i;
    if (i >= text.size()) break;
    const char quote = text[i];
    if (quote != '"' && quote != '\'') break;
    const std::size_t end = text.find(quote, i + 1);
    if (end == std::string_view::npos) break;
    tag.attributes[name] = text.substr(i + 1, end - i - 1);
    i = end + 1;
  }
  return tag;
}

// Numbers of a text, whatever stands between them.
std::vector<double> NumbersIn(std::string_view text) {
  std::vector<double> numbers;
  const std::string copy(text);
  const char* at = copy.c_str();
  while (*at != '\0') {
    char* end = nullptr;
    const double value = std::strtod(at, &end);
    if (end == at) {
      ++at;
    } else {
      if (std::isfinite(value)) numbers.push_back(value);
      at = end;
    }
  }
  return numbers;
}

// "#rrggbb" of "rgb( 0, 114, 178)", "#RRGGBB" or a plain word; else black.
std::string Colour(std::string_view text) {
  if (text.starts_with("rgb")) {
    const std::vector<double> parts = NumbersIn(text);
    if (parts.size() != 3) return "#000";
    const auto byte = [&](std::size_t i) {
      return static_cast<unsigned>(parts[i]) & 0xffU;
    };
    return fmt::format("#{:02x}{:02x}{:02x}", byte(0), byte(1), byte(2));
  }
  for (const char c : text) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '#') {
      return "#000";
    }
  }
  return text.empty() ? "#000" : std::string(text);
}

// M, L and Z with coordinates to a tenth, points that repeat left out.
std::string CompactPath(std::string_view d) {
  std::string path;
  std::string last;
  char command = 'L';
  std::size_t i = 0;
  std::vector<double> pair;
  while (i < d.size()) {
    const char c = d[i];
    if (c == 'M' || c == 'L') {
      command = c;
      ++i;
    } else if (c == 'Z' || c == 'z') {
      path += 'Z';
      last.clear();
      ++i;
    } else if (IsBlank(c) || c == ',') {
      ++i;
    } else {
      const std::size_t end = d.find_first_not_of("0123456789.-+eE", i);
      const std::size_t stop = end == std::string_view::npos ? d.size() : end;
      if (stop == i) return "";  // No path of gnuplot's.
      pair.push_back(
          std::strtod(std::string(d.substr(i, stop - i)).c_str(), nullptr));
      i = stop;
      if (pair.size() < 2) continue;
      const std::string point = Tenth(pair[0]) + " " + Tenth(pair[1]);
      pair.clear();
      if (command == 'L' && point == last) continue;
      path += command + point;
      last = point;
      command = 'L';
    }
  }
  return path;
}

double ValueOf(const Attributes& attributes,
               std::string_view key,
               double other) {
  const auto found = attributes.find(key);
  return found == attributes.end()
             ? other
             : std::strtod(found->second.c_str(), nullptr);
}

std::string TextOf(const Attributes& attributes, std::string_view key) {
  const auto found = attributes.find(key);
  return found == attributes.end() ? "" : found->second;
}

// The page, written as flat shapes; those of one style become one path.
class Canvas {
 public:
  void Stroke(const std::string& d, const std::string& style) {
    Join(d, "fill=\"none\" " + style);
  }

  // Joins what is painted alike: one after another, so none is hidden.
  void Join(const std::string& d, const std::string& style) {
    if (d.empty()) return;
    if (style != style_) {
      Flush();
      style_ = style;
    }
    path_ += d;
  }

  void Add(const std::string& element) {
    Flush();
    body_ += element;
  }

  std::string Take() {
    Flush();
    return std::move(body_);
  }

 private:
  std::string body_;
  std::string style_;
  std::string path_;

  void Flush() {
    if (!path_.empty()) {
      body_ += fmt::format("<path d=\"{}\" {}/>", path_, style_);
    }
    path_.clear();
    style_.clear();
  }
};

void AddPath(const Tag& tag, const Attributes& inherited, Canvas* canvas) {
  std::string style = fmt::format("stroke=\"{}\" stroke-width=\"{:.3g}\"",
                                  Colour(TextOf(tag.attributes, "stroke")),
                                  ValueOf(inherited, "stroke-width", 1.0));
  std::string dashes;
  for (const double dash :
       NumbersIn(TextOf(tag.attributes, "stroke-dasharray"))) {
    dashes += (dashes.empty() ? "" : " ") + Tenth(dash);
  }
  if (!dashes.empty()) style += fmt::format(" stroke-dasharray=\"{}\"", dashes);
  canvas->Stroke(CompactPath(TextOf(tag.attributes, "d")), style);
}

// A point: a dot or square is the cap of a line without length.
void AddPoint(const Tag& tag, Canvas* canvas) {
  const std::vector<double> place =
      NumbersIn(TextOf(tag.attributes, "transform"));
  if (place.size() != 3) return;
  const std::string colour = Colour(TextOf(tag.attributes, "color"));
  const std::string kind = TextOf(tag.attributes, "xlink:href");
  const double x = place[0];
  const double y = place[1];
  const double radius = place[2];
  if (kind == "#gpPt6" || kind == "#gpPt4") {
    canvas->Stroke(
        fmt::format("M{} {}h0", Tenth(x), Tenth(y)),
        fmt::format("stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"{}\"",
                    colour,
                    Tenth(2.0 * radius),
                    kind == "#gpPt6" ? "round" : "square"));
  } else if (kind == "#gpPt5") {
    canvas->Add(
        fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"#fff\" "
                    "stroke=\"{}\" stroke-width=\"1.4\"/>",
                    Tenth(x),
                    Tenth(y),
                    Tenth(radius),
                    colour));
  } else {
    const std::string r = Tenth(radius * 1.2);
    canvas->Add(
        fmt::format("<path d=\"M{} {}l{} {}l-{} {}l-{} -{}Z\" fill=\"{}\"/>",
                    Tenth(x),
                    Tenth(y - radius * 1.2),
                    r,
                    r,
                    r,
                    r,
                    r,
                    r,
                    colour));
  }
}

void AddPolygon(const Tag& tag, Canvas* canvas) {
  const std::vector<double> points =
      NumbersIn(TextOf(tag.attributes, "points"));
  std::string d;
  for (std::size_t i = 0; i + 1 < points.size(); i += 2) {
    d += (i == 0 ? "M" : "L") + Tenth(points[i]) + " " + Tenth(points[i + 1]);
  }
  if (d.empty()) return;
  std::string style =
      fmt::format("fill=\"{}\"", Colour(TextOf(tag.attributes, "fill")));
  const double opacity = ValueOf(tag.attributes, "fill-opacity", 1.0);
  if (opacity < 1.0) style += fmt::format(" fill-opacity=\"{:.3g}\"", opacity);
  // Neighbours that touch leave no seam between them.
  canvas->Join(d + "Z", style + " shape-rendering=\"crispEdges\"");
}

// `content` is escaped already, by gnuplot.
void AddText(const std::string& content,
             const Attributes& inherited,
             Canvas* canvas) {
  const std::vector<double> place = NumbersIn(TextOf(inherited, "transform"));
  if (place.size() < 2 || content.find_first_not_of(' ') == std::string::npos) {
    return;
  }
  std::string style = fmt::format("font-size=\"{:.3g}\"",
                                  ValueOf(inherited, "font-size", 12.0));
  const std::string anchor = TextOf(inherited, "text-anchor");
  if (anchor == "middle" || anchor == "end") {
    style += fmt::format(" text-anchor=\"{}\"", anchor);
  }
  if (place.size() == 3) {
    style += fmt::format(" transform=\"rotate({} {} {})\"",
                         Tenth(place[2]),
                         Tenth(place[0]),
                         Tenth(place[1]));
  }
  const std::size_t first = content.find_first_not_of(' ');
  canvas->Add(fmt::format("<text x=\"{}\" y=\"{}\" {}>{}</text>",
                          Tenth(place[0]),
                          Tenth(place[1]),
                          style,
                          content.substr(first)));
}

// Text is what gnuplot escaped: a '<' can only begin a tag.
class Reader {
 public:
  explicit Reader(std::string_view svg) : svg_(svg) {}

  std::string Body(double* width, double* height) {
    std::size_t at = svg_.find("<svg");
    if (at == std::string_view::npos) return "";
    bool ended = false;
    while ((at = svg_.find('<', at)) != std::string_view::npos) {
      const std::size_t end = svg_.find('>', at);
      if (end == std::string_view::npos) return "";
      const Tag tag = ParseTag(svg_.substr(at + 1, end - at - 1));
      at = end + 1;
      if (tag.name == "svg") {
        if (tag.closes) {
          ended = true;
          break;
        }
        const std::vector<double> box =
            NumbersIn(TextOf(tag.attributes, "viewBox"));
        if (box.size() == 4) {
          *width = box[2];
          *height = box[3];
        }
      } else if (tag.name == "defs") {
        in_defs_ = !tag.closes;
      } else if (!in_defs_) {
        at = Take(tag, at);
      }
    }
    // A broken end means that gnuplot died while it wrote.
    return ended ? canvas_.Take() : "";
  }

 private:
  std::string_view svg_;
  bool in_defs_ = false;
  std::vector<Attributes> groups_;
  Canvas canvas_;

  Attributes Inherited() const {
    Attributes all;
    for (const Attributes& group : groups_) {
      for (const auto& [key, value] : group) all[key] = value;
    }
    return all;
  }

  // Returns where to read on.
  std::size_t Take(const Tag& tag, std::size_t at) {
    if (tag.name == "g") {
      if (!tag.closes && !tag.alone) groups_.push_back(tag.attributes);
      if (tag.closes && !groups_.empty()) groups_.pop_back();
    } else if (tag.closes) {
      return at;
    } else if (tag.name == "path") {
      AddPath(tag, Inherited(), &canvas_);
    } else if (tag.name == "use") {
      AddPoint(tag, &canvas_);
    } else if (tag.name == "polygon") {
      AddPolygon(tag, &canvas_);
    } else if (tag.name == "text") {
      const std::size_t end = svg_.find("</text>", at);
      if (end == std::string_view::npos) return svg_.size();
      AddText(WithoutTags(svg_.substr(at, end - at)), Inherited(), &canvas_);
      return end;
    }
    return at;
  }

  static std::string WithoutTags(std::string_view text) {
    std::string plain;
    bool inside = false;
    for (const char c : text) {
      if (c == '<') inside = true;
      if (!inside) plain += c == '\n' || c == '\t' ? ' ' : c;
      // Outside of a tag a '>' is text: gnuplot leaves it as it is.
      if (inside && c == '>') inside = false;
    }
    return plain;
  }
};

}  // namespace

std::string CompactSvg(std::string_view svg,
                       std::string_view attributes,
                       std::string_view head) {
  double width = 0.0;
  double height = 0.0;
  const std::string body = Reader(svg).Body(&width, &height);
  if (body.empty() || !(width > 0.0) || !(height > 0.0)) return "";
  return fmt::format(
      "<svg viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" {}>{}{}</svg>",
      Tenth(width),
      Tenth(height),
      Tenth(width),
      Tenth(height),
      attributes,
      head,
      body);
}

}  // namespace errmap::cli
