#pragma once
/// One look at a box of designs: every demand, as planes.

#include <map>
#include <memory>
#include <vector>

#include "proof/admissible/demands.hpp"
#include "proof/admissible/pieces.hpp"

namespace ninedof::admissible {

/// A box, and what a box around it has handed on.
struct ToExamine {
  DesignBox box;
  std::vector<char> kept;  ///< of each demand: kept by all designs of the box; empty: none is known to be
  std::vector<Loss> near;  ///< where designs around it broke demands
  /// Of items: the boxes of poses at which they are not known to be kept.
  std::map<std::size_t, std::shared_ptr<const std::vector<Box>>> open;
};

struct Examined {
  Knowledge known;
  ToExamine inherited;  ///< for parts of the box, which is that of the whole still
  long boxes = 0;       ///< of poses
  bool finished = false;
};

class Examiner {
 public:
  explicit Examiner(const DesignQuestion& question);
  const std::vector<Demand>& names() const { return demands_.names; }
  /// Not finished where it was stopped.
  Examined examine(const ToExamine& asked, const std::stop_token& stop) const;
  /// Whether these witnesses show that no design of the box is inside; their planes go to `known`.
  bool breaks(const DesignBox& box, const std::vector<Loss>& witnesses, const std::vector<int>& some,
              Knowledge& known) const;
  /// Of each demand that a design, a box of no width, breaks at a witness: the worst one.
  std::vector<int> worst_of(const DesignBox& design, const std::vector<Loss>& witnesses) const;
  /// With the poses at which limits are broken.
  std::vector<DesignPiece> pieces_of(const std::vector<Piece>& pieces) const;
  MetAt met_at(const Box& point, const DesignBox& designs) const;

 private:
  Met meet(const DesignsAt& designs, const Spreads& spreads, const Loss& loss, bool closely = false) const;
  /// Whether no design is inside, by where another broke a demand; the plane of those that are not goes to `known`.
  bool is_lost(const DesignsAt& designs, const Spreads& spreads, const Loss& witness, bool closely,
               Knowledge& known) const;
  std::vector<Box> roots_of(const Item& item) const;

  const DesignQuestion& question_;
  Poses poses_;
  Demands demands_;
};

}  // namespace ninedof::admissible
