#include <cstdio>

int main() { std::printf("dressform " DRESSFORM_VERSION "\n"); }
