#!/bin/sh
# tests/kernels_leak_nothing.sh OBJECT...: fails where a kernel object has a weak or undefined symbol. A weak one, an inline
# function of a header, could be linked into code for processors that lack its instructions; an undefined one could be another's.
status=0
for object; do
  found=$(nm -C "$object" | grep -E ' [WVuU] ' | grep -vE ' (memcpy|memset|memmove|_GLOBAL_OFFSET_TABLE_|__stack_chk_fail)$')
  if [ -n "$found" ]; then
    printf '%s\n%s\n' "$object" "$found"
    status=1
  fi
  nm -C "$object" | grep -q level_table || { echo "$object has no table"; status=1; }
done
exit $status
