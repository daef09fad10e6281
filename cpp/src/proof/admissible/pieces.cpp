#include "proof/admissible/pieces.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

namespace ninedof::admissible {
namespace {

/// Halvings below a box, by its number of coordinates.
constexpr std::array<int, most_varied + 1> most_halvings{0, 7, 10, 10, 10, 10, 10};

/// A part of a box in its coordinates t, and its halves if it was divided.
struct Node {
  std::array<double, most_varied> low{}, high{};
  Membership state = Membership::undecided;
  const Loss* loss = nullptr;
  std::array<std::unique_ptr<Node>, 2> half;
  double undecided = 0.0;  ///< of the volume in t
};

class Division {
 public:
  Division(const DesignBox& box, std::size_t dimensions, const DesignBox& range, const Knowledge& known)
      : box_(box), dimensions_(dimensions), range_(range), known_(known) {}

  Divided run() {
    Node root;
    root.low.fill(-1.0);
    root.high.fill(1.0);
    std::vector<const Plane*> cuts;
    for (const Plane& cut : known_.cuts) cuts.push_back(&cut);
    std::vector<const Loss*> losses;
    for (const Loss& loss : known_.losses) losses.push_back(&loss);
    fill(root, cuts, losses, most_halvings[dimensions_]);
    const Node* tight = descended(root);
    if (tight == &root && root.half[0] != nullptr)
      for (const auto& half : root.half) rest(*descended(*half));
    else if (tight == &root && root.undecided > 0.0) halve_whole(root);
    else if (tight != nullptr) rest(*tight);
    return std::move(out_);
  }

 private:
  void fill(Node& node, std::vector<const Plane*> cuts, std::vector<const Loss*> losses, int halvings) const {
    for (const Loss* loss : losses)
      if (value(loss->most, node, 1.0) < 0.0) {
        node.state = Membership::outside;
        node.loss = loss;
        return;
      }
    std::erase_if(losses, [&](const Loss* loss) { return value(loss->most, node, -1.0) >= 0.0; });
    std::erase_if(cuts, [&](const Plane* cut) { return value(*cut, node, -1.0) > 0.0; });
    if (known_.complete && cuts.empty()) {
      node.state = Membership::inside;
      return;
    }
    const int k = halvings > 0 ? coordinate(node, cuts, losses, halvings) : -1;
    if (k < 0) {
      node.undecided = 1.0;
      for (std::size_t i = 0; i < dimensions_; ++i) node.undecided *= 0.5 * (node.high[i] - node.low[i]);
      return;
    }
    const auto at = static_cast<std::size_t>(k);
    for (const int side : {0, 1}) {
      auto half = std::make_unique<Node>();
      half->low = node.low;
      half->high = node.high;
      (side == 0 ? half->high : half->low)[at] = 0.5 * (node.low[at] + node.high[at]);
      fill(*half, cuts, losses, halvings - 1);
      node.undecided += half->undecided;
      node.half[static_cast<std::size_t>(side)] = std::move(half);
    }
    // Halves of one state are one.
    const auto& [a, b] = node.half;
    if (a->half[0] != nullptr || b->half[0] != nullptr || a->state != b->state || a->loss != b->loss) return;
    node.state = a->state;
    node.loss = a->loss;
    node.half = {};
  }
  /// The least or the greatest value of a plane in a node, by `way`.
  double value(const Plane& p, const Node& node, double way) const {
    double out = p.c;
    for (std::size_t k = 0; k < dimensions_; ++k) {
      const double middle = 0.5 * (node.low[k] + node.high[k]), half = 0.5 * (node.high[k] - node.low[k]);
      out += p.a[k] * middle + way * std::abs(p.a[k]) * half;
    }
    return out + way * 0x1p-46 * (std::abs(p.c) + slopes_of(p));
  }
  /// First the widest as part of the range; then that by which the planes change most. None where there are no planes.
  int coordinate(const Node& node, const std::vector<const Plane*>& cuts, const std::vector<const Loss*>& losses,
                 int halvings) const {
    std::array<double, most_varied> most{};
    const bool first = halvings == most_halvings[dimensions_];
    for (std::size_t k = 0; k < dimensions_; ++k) {
      const double width = node.high[k] - node.low[k];
      if (first) {
        most[k] = (box_.high[k] - box_.low[k]) / (range_.high[k] - range_.low[k]);
        continue;
      }
      for (const Plane* cut : cuts) most[k] = std::max(most[k], std::abs(cut->a[k]) / slopes_of(*cut) * width);
      for (const Loss* loss : losses)
        most[k] = std::max(most[k], std::abs(loss->most.a[k]) / slopes_of(loss->most) * width);
    }
    if (cuts.empty() && losses.empty()) return -1;
    const auto greatest = std::max_element(most.begin(), most.begin() + static_cast<std::ptrdiff_t>(dimensions_));
    return *greatest > 0.0 ? static_cast<int>(greatest - most.begin()) : -1;
  }

  DesignBox in_variables(const Node& node) const {
    DesignBox out;
    for (std::size_t k = 0; k < dimensions_; ++k) {
      const auto at = [&](double t) {
        return t <= -1.0  ? box_.low[k]
               : t >= 1.0 ? box_.high[k]
                          : box_.low[k] + 0.5 * (t + 1.0) * (box_.high[k] - box_.low[k]);
      };
      out.low[k] = at(node.low[k]);
      out.high[k] = at(node.high[k]);
    }
    return out;
  }
  void collect(const Node& node, std::vector<Piece>& out) const {
    if (node.half[0] == nullptr) {
      out.push_back({in_variables(node), node.state, node.loss});
      return;
    }
    for (const auto& half : node.half) collect(*half, out);
  }
  /// Down to the node both halves of which are undecided, or that has none; what is beside it is decided.
  const Node* descended(const Node& from) {
    const Node* node = &from;
    while (node->half[0] != nullptr) {
      const bool first = node->half[0]->undecided > 0.0, second = node->half[1]->undecided > 0.0;
      if (first && second) return node;
      collect(*node->half[first ? 1 : 0], out_.decided);
      node = node->half[first ? 0 : 1].get();
    }
    return node;
  }
  void rest(const Node& node) {
    if (!(node.undecided > 0.0)) {
      collect(node, out_.decided);
      return;
    }
    Rest one{in_variables(node), node.undecided * volume_of(box_, dimensions_), {}};
    collect(node, one.pieces);
    out_.rests.push_back(std::move(one));
  }
  /// A box of which nothing is known.
  void halve_whole(const Node& root) {
    std::size_t k = 0;
    for (std::size_t i = 1; i < dimensions_; ++i)
      if ((box_.high[i] - box_.low[i]) / (range_.high[i] - range_.low[i]) >
          (box_.high[k] - box_.low[k]) / (range_.high[k] - range_.low[k]))
        k = i;
    for (const bool upper : {false, true}) {
      Node half;
      half.low = root.low;
      half.high = root.high;
      (upper ? half.low : half.high)[k] = 0.0;
      half.undecided = 0.5;
      rest(half);
    }
  }

  const DesignBox& box_;
  std::size_t dimensions_;
  const DesignBox& range_;
  const Knowledge& known_;
  Divided out_;
};

}  // namespace

double volume_of(const DesignBox& box, std::size_t dimensions) {
  double out = 1.0;
  for (std::size_t k = 0; k < dimensions; ++k) out *= box.high[k] - box.low[k];
  return out;
}

bool is_divisible(const DesignBox& box, std::size_t dimensions, const DesignBox& range, double resolution) {
  for (std::size_t k = 0; k < dimensions; ++k)
    if (box.high[k] - box.low[k] > std::max(resolution, 1e-12) * (range.high[k] - range.low[k])) return true;
  return false;
}

Divided divided(const DesignBox& box, std::size_t dimensions, const DesignBox& range, const Knowledge& known) {
  return Division(box, dimensions, range, known).run();
}

}  // namespace ninedof::admissible
