/* Call the kernels of a library on the memory in a file: check_library LIBRARY SUFFIX BEFORE AFTER

   The file has words of 64 bits, little-endian: the numbers of addresses, calls and words of memory;
   then the places of the addresses in memory; the calls, each an entry and eleven arguments; and the
   memory. Addresses are offsets in bytes. The memory after the calls is written to another file. */

#include <dlfcn.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ARGUMENTS = 11, LINE = 64 };
static const char *const entries[] = {"run_batch", "run_rigid_batch", "run_two_springs"};
typedef int64_t Batch(void *, void *, void *, void *, double, double, int64_t, int64_t, void *, int64_t);
typedef int64_t Springs(void *, int64_t, void *, void *);

static double real(int64_t word) {
  double value;
  memcpy(&value, &word, sizeof value);
  return value;
}

static int64_t *words(FILE *file, int64_t count) {
  char *room = calloc((size_t)count * 8 + LINE, 1);
  int64_t *first = (int64_t *)(room + LINE - (uintptr_t)room % LINE);
  if (!room || fread(first, 8, (size_t)count, file) != (size_t)count) exit(3);
  return first;
}

int main(int count, char **given) {
  if (count != 5) return 2;
  void *library = dlopen(given[1], RTLD_NOW);
  FILE *file = fopen(given[3], "rb");
  if (!library || !file) return 2;
  int64_t *sizes = words(file, 3), *places = words(file, sizes[0]);
  int64_t *calls = words(file, sizes[1] * (1 + ARGUMENTS)), *memory = words(file, sizes[2]);
  char *begin = (char *)memory;
  for (int64_t k = 0; k < sizes[0]; k++) memory[places[k]] += (int64_t)(intptr_t)begin;
  for (int64_t k = 0; k < sizes[1]; k++) {
    const int64_t entry = calls[k * (1 + ARGUMENTS)], *a = calls + k * (1 + ARGUMENTS) + 1;
    char name[64];
    snprintf(name, sizeof name, "%s%s", entries[entry], given[2]);
    void *found = dlsym(library, name);
    if (!found) return 4;
    int64_t answer = 0;
    if (entry < 2)
      do answer = ((Batch *)found)(begin + a[0], begin + a[1], begin + a[2], begin + a[3], real(a[4]),
                                   real(a[5]), a[6], a[7], begin + a[8], answer);
      while (answer >= 0 && answer < a[10]);
    else
      answer = ((Springs *)found)(begin + a[0], a[1], begin + a[2], begin + a[3]);
    if (answer < 0) return 5;
  }
  for (int64_t k = 0; k < sizes[0]; k++) memory[places[k]] -= (int64_t)(intptr_t)begin;
  FILE *out = fopen(given[4], "wb");
  if (!out || fwrite(memory, 8, (size_t)sizes[2], out) != (size_t)sizes[2]) return 6;
  return fclose(out) ? 6 : 0;
}
