/* What a library for Windows begins with, in place of a C library's own: there is nothing to do. */

int __stdcall DllMainCRTStartup(void *library, unsigned long reason, void *reserved) {
  (void)library, (void)reason, (void)reserved;
  return 1;
}
