// A program that reads elevation models and pictures: all of bake_input is linked in, nothing of it is called.
int main() {
    return 0;
}
