// Loaded before a program (LD_PRELOAD), it leaves Highway one instruction set: TARGET, for example HWY_SSE4. Ends the
// program where the processor does not have it. same_bytes.py compiles it.
#include <hwy/highway.h>

#include <unistd.h>

namespace
{
__attribute__((constructor)) void forceTarget()
{
  if ((hwy::SupportedTargets() & TARGET) == 0)
  {
    ::_exit(1);
  }
  hwy::SetSupportedTargetsForTest(TARGET);
}
}
