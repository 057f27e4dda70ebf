#!/bin/sh
# Fails if a test program in the folder $1 lists a parameter by its bytes or address.
for program in "$1"/test_*; do
  "$program" --gtest_list_tests
done 2>/dev/null | grep -E -- '-byte object|[(, ]0x[0-9a-f]{6}' && exit 1
exit 0
