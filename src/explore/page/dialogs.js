export function createDialogs() { return { redraw() {}, retry() {}, open() {}, draw() {}, mark() {}, escape() {}, tool: '' }; }
