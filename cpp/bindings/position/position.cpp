#include <algorithm>
#include <array>
#include <vector>

#include "ninedof/position/certified_modes.hpp"
#include "ninedof/position/forward_position.hpp"
#include "ninedof/position/tracking.hpp"
#include "support/configurations.hpp"
#include "support/module.hpp"

namespace ninedof::python {
namespace {

/// Leg lengths, nine per row.
class LengthStack {
 public:
  explicit LengthStack(Array lengths) : lengths_(std::move(lengths)), data_(lengths_.data()) {
    if (lengths_.size() % 9 != 0)
      throw InvalidArgument("leg_lengths", std::to_string(lengths_.size()) + " numbers", "nine per row");
  }
  long count() const { return static_cast<long>(lengths_.size() / 9); }
  Vec9 operator[](long i) const { return Eigen::Map<const Vec9>(data_ + 9 * i); }

 private:
  Array lengths_;
  const double* data_;
};

template <class T>
py::array_t<T> array_of(const std::vector<T>& values) {
  // numpy would copy without the GIL, and a thread that asks for it while the interpreter ends is killed here.
  py::array_t<T> out(static_cast<py::ssize_t>(values.size()));
  std::copy(values.begin(), values.end(), out.mutable_data());
  return out;
}

/// A configuration as fifteen doubles: p, Q row-major, s.
constexpr py::ssize_t configuration_size = 15;

void write(const Configuration& c, double* to) {
  Eigen::Map<Vec3>{to} = c.position;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{to + 3} = c.rotation;
  Eigen::Map<Vec3>{to + 12} = c.internal_point;
}

/// Results of rows one after the other.
struct Rows {
  std::vector<int> counts;
  std::vector<double> configurations;

  void add(const Configuration& c) {
    configurations.resize(configurations.size() + configuration_size);
    write(c, configurations.data() + configurations.size() - configuration_size);
  }
};

/// Number of modes proved, of undecided boxes and of boxes examined for each row; the radii of all modes; the undecided
/// boxes.
py::tuple certificates(const std::vector<CertifiedModes>& found) {
  std::vector<int> proved;
  std::vector<long> boxes;
  std::vector<double> radii, undecided_radii;
  Rows undecided;
  for (const CertifiedModes& c : found) {
    proved.push_back(c.proved);
    boxes.push_back(c.boxes);
    radii.insert(radii.end(), c.radius.begin(), c.radius.begin() + c.modes.count);
    undecided.counts.push_back(static_cast<int>(c.undecided.size()));
    for (const UndecidedModes& box : c.undecided) {
      undecided.add(box.middle);
      undecided_radii.push_back(box.radius);
    }
  }
  return py::make_tuple(array_of(proved), array_of(undecided.counts), array_of(boxes), array_of(radii),
                        array_of(undecided.configurations), array_of(undecided_radii));
}

/// The modes of all rows one after the other; number of modes, status and certainty for each row; the certificates, or
/// None. Rows with NaN have no mode and the status "".
py::tuple forward_position_stack(const Geometry& g, const Array& leg_lengths, bool certify, int threads) {
  const LengthStack lengths(leg_lengths);
  if (certify) require_sound_arithmetic();  // also for an empty stack
  const auto rows = static_cast<std::size_t>(lengths.count());
  std::vector<CertifiedModes> found(rows);
  in_slices(lengths.count(), certify ? 1 : 64, threads, [&](long first, long last) {
    for (long i = first; i < last; ++i) {
      const Vec9 row = lengths[i];
      CertifiedModes& to = found[static_cast<std::size_t>(i)];
      if (row.hasNaN()) continue;
      if (certify) to = certified_modes(g, row);
      else to.modes = forward_position(g, row);
    }
  });
  Rows all;
  std::vector<int> sides;
  std::vector<std::uint8_t> certain(rows);
  std::vector<double> separations;
  py::list status, obstacle;
  for (std::size_t i = 0; i < rows; ++i) {
    const AssemblyModes& m = found[i].modes;
    const bool missing = lengths[static_cast<long>(i)].hasNaN();
    all.counts.push_back(m.count);
    certain[i] = !missing && m.certain;
    status.append(missing ? "" : to_string(m.status));
    obstacle.append(missing ? "" : to_string(m.obstacle));
    for (const AssemblyMode& mode : m) {
      all.add(mode.configuration);
      separations.push_back(mode.separation);
      sides.push_back(mode.base_side);
      sides.push_back(mode.platform_side);
    }
  }
  return py::make_tuple(array_of(all.counts), status, obstacle, array_of(certain), array_of(all.configurations),
                        array_of(separations), array_of(sides), certify ? py::object(certificates(found)) : py::none());
}

/// Number of doubles of a tracked step: configuration, certificate, alone_within, separation, steps, reached.
constexpr py::ssize_t tracked_size = configuration_size + 5;

void write(const Tracked& t, double* to) {
  write(t.configuration, to);
  to += configuration_size;
  const std::array<double, 5> rest{t.certificate, t.alone_within, t.separation, static_cast<double>(t.steps),
                                   t.reached};
  std::copy(rest.begin(), rest.end(), to);
}

/// A sequence of `path` rows of lengths for each start: (n, path, 9) lengths and n starts.
py::tuple track_stack(const Geometry& g, const Array& leg_lengths, long path, const ConfigurationStack& starts,
                      int threads) {
  const LengthStack lengths(leg_lengths);
  if (lengths.count() != starts.count() * path)
    throw InvalidArgument("leg_lengths", std::to_string(lengths.count()) + " rows",
                          std::to_string(starts.count() * path));
  const Tracker tracker(g);
  Array out(std::vector<py::ssize_t>{lengths.count(), tracked_size});
  std::vector<std::uint8_t> status(static_cast<std::size_t>(lengths.count()));
  double* data = out.mutable_data();
  in_slices(starts.count(), path > 100 ? 1 : 256, threads, [&](long first, long last) {
    for (long i = first; i < last; ++i) {
      Configuration at = starts[i];
      bool going = true;
      for (long k = i * path; k < (i + 1) * path; ++k) {
        const Vec9 row = lengths[k];
        const Tracked t = going && !row.hasNaN() ? tracker(row, at) : Tracked::not_tried();
        going &= t.status == TrackStatus::tracked;
        at = t.configuration;
        write(t, data + k * tracked_size);
        status[static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(t.status);
      }
    }
  });
  return py::make_tuple(out, array_of(status));
}

}  // namespace

void bind_position(py::module_& m) {
  m.def("forward_position", &forward_position_stack);
  m.def("track", &track_stack);
  py::list names;
  for (const TrackStatus s : {TrackStatus::tracked, TrackStatus::lost, TrackStatus::infeasible, TrackStatus::unproved})
    names.append(to_string(s));
  m.attr("track_statuses") = names;
}

}  // namespace ninedof::python
