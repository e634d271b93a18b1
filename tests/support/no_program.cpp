// What the precompiled headers of the tests hang on.
int main() {
    return 0;
}
