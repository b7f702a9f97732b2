// SPDX-License-Identifier: BSD-3-Clause
// Search for the item of a place (Roger 2008, section 4.3.2). Whoever includes this defines invalidUpTo(j), how many of
// items 0 to j are invalid, and isInvalid(j), fetches both. IMPROVED: by figure 4.7.

uint searchFetches;

// Of `size` items the place-th valid one, counted from 0; `size` if there are fewer.
uint findItem(uint place, uint size) {
  searchFetches = 1u;
  uint high = place + invalidUpTo(size - 1u);
  if (high >= size) return size;
  ++searchFetches;
  uint low = place + invalidUpTo(place);
#ifdef IMPROVED
  while (true) {
    const uint guess = (low + high) / 2u;
    ++searchFetches;
    const int off = int(guess) - int(invalidUpTo(guess)) - int(place);
    if (off == 0) {
      ++searchFetches;
      if (!isInvalid(guess)) return guess;
    }
    if (low >= high) return guess;  // sums that fit no stream
    // A step to the left or right passes one valid item at most.
    if (off < 0)
      low = guess - uint(off);
    else
      high = guess - uint(max(1, off));
  }
#else
  // The first item that has place + 1 valid ones up to it.
  for (uint range = size; range > 1u; range -= range / 2u) {
    const uint guess = (low + high) / 2u;
    ++searchFetches;
    if (guess + 1u - invalidUpTo(guess) > place)
      high = guess;
    else
      low = guess + 1u;
  }
  return low;
#endif
}
