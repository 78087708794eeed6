// A program that reads baked files and decides what to draw: all of formats and of runtime's deciding halves is linked in.
int main() {
    return 0;
}
