#pragma once
/// Peak throughput of one core at each level of instructions, in nanoseconds per number (lane) of many independent
/// ones.

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
