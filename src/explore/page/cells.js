export function createCells() { return { redraw() {}, retry() {}, open() {}, draw() {}, mark() {}, escape() {}, tool: '' }; }
