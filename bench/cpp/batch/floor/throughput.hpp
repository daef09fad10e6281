#pragma once
/// What one core does at most, at each level of instructions. Nanoseconds a number (a lane), of many independent ones.

namespace bench {

struct Throughput {
  double multiply, add;  ///< each alone
  double both;           ///< one of each, in separate streams, as the library is compiled
  double fused;          ///< both in one instruction; 0 where the level has none
  double divide, root;
};

namespace base {
Throughput throughput();
}
namespace v3 {
Throughput throughput();
}
namespace v4 {
Throughput throughput();
}

}  // namespace bench
