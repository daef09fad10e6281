#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ninedof/math/interval.hpp"
#include "ninedof/position/certified_modes.hpp"
#include "ninedof/position/forward_position.hpp"
#include "ninedof/position/tracking.hpp"
#include "support/module.hpp"
#include "support/struct.hpp"

namespace ninedof::python {
namespace {

/// A configuration as fifteen doubles: p, Q row-major, s.
constexpr py::ssize_t configuration_size = 15;

void write(const Configuration& c, double* to) {
  Eigen::Map<Vec3>{to} = c.position;
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{to + 3} = c.rotation;
  Eigen::Map<Vec3>{to + 12} = c.internal_point;
}

void append(const Configuration& c, std::vector<double>& to) {
  to.resize(to.size() + configuration_size);
  write(c, to.data() + to.size() - configuration_size);
}

/// The certificates of rows of lengths: three numbers of each, the radii of all modes, all undecided boxes.
struct CertificateColumns {
  std::vector<int> proved, undecided;
  std::vector<long> boxes;
  std::vector<double> radius, places, place_radius;

  void add(const CertifiedModes& c) {
    proved.push_back(c.proved);
    boxes.push_back(c.boxes);
    radius.insert(radius.end(), c.radius.begin(), c.radius.begin() + c.modes.count);
    undecided.push_back(static_cast<int>(c.undecided.size()));
    for (const UndecidedModes& box : c.undecided) {
      append(box.middle, places);
      place_radius.push_back(box.radius);
    }
  }
};

/// Of rows of lengths: three columns with a row for each, then the modes of all rows one after the other.
struct ModeColumns {
  std::vector<int> count, side;
  std::vector<std::string> status, obstacle;
  std::vector<std::uint8_t> certain;
  std::vector<double> configuration, separation;
  std::optional<CertificateColumns> certificate;

  /// A row with NaN has no mode and the status "".
  void add(const AssemblyModes& m, bool missing) {
    count.push_back(m.count);
    certain.push_back(!missing && m.certain);
    status.push_back(missing ? "" : to_string(m.status));
    obstacle.push_back(missing ? "" : to_string(m.obstacle));
    for (const AssemblyMode& mode : m) {
      append(mode.configuration, configuration);
      separation.push_back(mode.separation);
      side.insert(side.end(), {mode.base_side, mode.platform_side});
    }
  }
};

ModeColumns forward_position_stack(const Geometry& g, const Array& leg_lengths, bool certify, int threads) {
  const std::vector<Vec9> lengths = lengths_from(leg_lengths);
  if (certify) require_sound_arithmetic();  // also for an empty stack
  std::vector<CertifiedModes> found(lengths.size());
  in_slices(std::ssize(lengths), certify ? 1 : 64, threads, [&](long first, long last) {
    for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
      if (lengths[i].hasNaN()) continue;
      if (certify) found[i] = certified_modes(g, lengths[i]);
      else found[i].modes = forward_position(g, lengths[i]);
    }
  });
  ModeColumns out;
  if (certify) out.certificate.emplace();
  for (std::size_t i = 0; i < found.size(); ++i) {
    out.add(found[i].modes, lengths[i].hasNaN());
    if (certify) out.certificate->add(found[i]);
  }
  return out;
}

void bind_columns(py::module_& m) {
  using Proof = CertificateColumns;
  py::class_<Proof>(m, "CertificateColumns", "The certificates of the modes of rows of lengths.")
      .def_property_readonly("proved", column_of<int>(&Proof::proved), "Modes of each row.")
      .def_property_readonly("undecided", column_of<int>(&Proof::undecided), "Boxes of each row.")
      .def_property_readonly("boxes", column_of<long>(&Proof::boxes), "Examined, of each row.")
      .def_property_readonly("radius", column_of<double>(&Proof::radius), "Of each mode.")
      .def_property_readonly("places", column_of<double>(&Proof::places), "p, Q and s of each undecided box.")
      .def_property_readonly("place_radius", column_of<double>(&Proof::place_radius), "Of each undecided box.");
  using Modes = ModeColumns;
  py::class_<Modes>(m, "ModeColumns", "The modes of rows of lengths.")
      .def_property_readonly("count", column_of<int>(&Modes::count), "Modes of each row.")
      .def_readonly("status", &Modes::status, "Of each row; empty where it has NaN.")
      .def_readonly("obstacle", &Modes::obstacle, "Of each row.")
      .def_property_readonly("certain", column_of<std::uint8_t>(&Modes::certain), "Whether the count is confirmed.")
      .def_property_readonly("configuration", column_of<double>(&Modes::configuration), "p, Q and s of each mode.")
      .def_property_readonly("separation", column_of<double>(&Modes::separation), "Of each mode.")
      .def_property_readonly("side", column_of<int>(&Modes::side), "Two of each mode: of the base, of the platform.")
      .def_readonly("certificate", &Modes::certificate, "If it is asked for, or None.");
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
  const double* lengths = rows("leg_lengths", leg_lengths, starts.count() * path, 9);
  const Tracker tracker(g);
  Array out(std::vector<py::ssize_t>{starts.count() * path, tracked_size});
  py::array_t<std::uint8_t> statuses(starts.count() * path);
  std::uint8_t* status = statuses.mutable_data();
  double* data = out.mutable_data();
  in_slices(starts.count(), path > 100 ? 1 : 256, threads, [&](long first, long last) {
    for (long i = first; i < last; ++i) {
      Configuration at = starts[i];
      bool going = true;
      for (long k = i * path; k < (i + 1) * path; ++k) {
        const Vec9 row = Eigen::Map<const Vec9>(lengths + 9 * k);
        const Tracked t = going && !row.hasNaN() ? tracker(row, at) : Tracked::not_tried();
        going &= t.status == TrackStatus::tracked;
        at = t.configuration;
        write(t, data + k * tracked_size);
        status[k] = static_cast<std::uint8_t>(t.status);
      }
    }
  });
  return py::make_tuple(out, statuses);
}

}  // namespace

void bind_position(py::module_& m) {
  bind_columns(m);
  m.def("forward_position", &forward_position_stack);
  m.def("track", &track_stack);
  py::list names;
  for (const TrackStatus s : {TrackStatus::tracked, TrackStatus::lost, TrackStatus::infeasible, TrackStatus::unproved})
    names.append(to_string(s));
  m.attr("track_statuses") = names;
}

}  // namespace ninedof::python
