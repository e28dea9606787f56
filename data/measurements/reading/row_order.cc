#include "data/measurements/reading/row_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

#include "data/text.h"

namespace errmap::data {
namespace {

using Eigen::Index;

using Span = std::pair<double, double>;

// Whether nearly all rows of a session have a time of their own.
bool AreDistinct(const Eigen::VectorXd& time,
                 const std::vector<std::string>& sessions) {
  std::vector<std::pair<std::string, double>> moments;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    moments.emplace_back(sessions[i], time[static_cast<Index>(i)]);
  }
  std::ranges::sort(moments);
  const auto distinct =
      std::unique(moments.begin(), moments.end()) - moments.begin();
  return 10 * distinct >= 9 * std::ssize(sessions);
}

// Whether no session begins before another ends.
template <typename Label>
bool LieApart(const Eigen::VectorXd& time, const std::vector<Label>& sessions) {
  std::map<Label, Span> spans;
  for (std::size_t i = 0; i < sessions.size(); ++i) {
    const double at = time[static_cast<Index>(i)];
    Span& span = spans.try_emplace(sessions[i], at, at).first->second;
    span = {std::min(span.first, at), std::max(span.second, at)};
  }
  std::vector<Span> in_order;
  for (const auto& [session, span] : spans) in_order.push_back(span);
  std::ranges::sort(in_order);
  for (std::size_t i = 1; i < in_order.size(); ++i) {
    if (in_order[i].first < in_order[i - 1].second) return false;
  }
  return true;
}

bool RanksBefore(const std::string& a,
                 const std::string& b,
                 const std::map<std::string, std::size_t>& rank) {
  double of_a = 0.0;
  double of_b = 0.0;
  if (ParseNumber(a, &of_a) && ParseNumber(b, &of_b)) return of_a < of_b;
  return rank.at(a) < rank.at(b);
}

}  // namespace

std::optional<std::vector<Index>> OrderOfTime(
    const Eigen::VectorXd& time, const std::vector<std::string>& sessions) {
  if (!AreDistinct(time, sessions)) return std::nullopt;
  const bool apart = LieApart(time, sessions);
  std::map<std::string, std::size_t> rank;
  for (const std::string& session : sessions) {
    rank.try_emplace(session, rank.size());
  }
  std::vector<Index> places(sessions.size());
  std::iota(places.begin(), places.end(), Index{0});
  std::ranges::stable_sort(places, [&](Index a, Index b) {
    const auto& of_a = sessions[static_cast<std::size_t>(a)];
    const auto& of_b = sessions[static_cast<std::size_t>(b)];
    if (!apart && of_a != of_b) return RanksBefore(of_a, of_b, rank);
    return time[a] < time[b];
  });
  return places;
}

bool FilesInterleave(const Eigen::VectorXd& time,
                     const std::vector<Index>& files) {
  return !LieApart(time, files);
}

bool AreMixed(const std::vector<double>& cycles,
              const std::vector<Index>& positions) {
  constexpr std::size_t kFewestRows = 12;
  constexpr std::size_t kFewRows = 6;  // of a cycle in one piece
  if (cycles.size() < kFewestRows) return false;
  double first = INFINITY;
  for (const double cycle : cycles) first = std::min(first, cycle);
  std::size_t changes = 0;
  std::size_t odd = 0;
  for (std::size_t i = 1; i < cycles.size(); ++i) {
    const double now = cycles[i];
    const double before = cycles[i - 1];
    if (now == before || std::isnan(now - before)) continue;
    ++changes;
    const bool stays = !positions.empty() && positions[i] == positions[i - 1];
    odd += stays || (now != before + 1.0 && now != first) ? 1 : 0;
  }
  return 2 * odd > changes && kFewRows * changes > cycles.size();
}

}  // namespace errmap::data
